// The command `barehand scan-object`, which saves the shape of an object that a hand turns.
#include "app/scan/scan_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/scan/object_scan.h"
#include "app/shared/outputs.h"
#include "app/shared/run_inputs.h"
#include "app/shared/standard_streams.h"
#include "app/track/track_command.h"
#include "app/track/track_run.h"
#include "core/format.h"
#include "core/parallel/parallel.h"
#include "io/atomic_file.h"
#include "io/file_ending.h"
#include "io/obj_file.h"
#include "stages/contact/scanned_mesh.h"

namespace barehand {
namespace {

constexpr const char* kHowToScan =
    "Hold the object with your fingertips, and turn it slowly until every side has faced the sensor. Change the grip,\n"
    "so that the fingers uncover what they hide. Ctrl-C ends a live scan; what was seen until then is saved.";
constexpr double kFine = 0.003, kCoarse = 0.006;  // triangle sizes for the saved mesh and for messages [m]
constexpr double kScanMargin = 0.08;              // least margin around the hand in which the object is observed [m]
constexpr double kLittle = 0.3;                   // a mesh of which less than this fraction was seen is hardly useful

struct ScanOptions {
  TrackOptions track;
  std::string out;
};

/// What a mesh shows, for people: "object 1, 98 x 95 x 97 mm, 63 % of its surface seen".
std::string described(const ObjectScan::Object& object, const ScannedMesh& scanned) {
  const Eigen::Vector3f mm = 1000 * bounding_box(scanned.mesh).sizes();
  return formatted("object %d, %.0f x %.0f x %.0f mm, %.0f %% of its surface seen", object.id, mm.x(), mm.y(), mm.z(),
                   100 * scanned.seen);
}

/// Says from time to time how much was seen.
class ScanAdvice {
 public:
  void give(const ObjectScan& scan) {
    const auto now = std::chrono::steady_clock::now();
    if (now < given_ + kPause) return;
    given_ = now;
    const ObjectScan::Object* object = scan.object();
    const ScannedMesh scanned = object ? scanned_mesh(object->surface, kCoarse) : ScannedMesh();
    std::cerr << "\n"
              << (scanned.mesh.triangles.empty() ? "no object is seen in or near the hand yet"
                                                 : described(*object, scanned))
              << std::endl;
  }

 private:
  static constexpr std::chrono::seconds kPause{4};
  std::chrono::steady_clock::time_point given_ = std::chrono::steady_clock::now();
};

Result<void> check_output(const std::string& path) {
  if (lower_case_ending(path) != ".obj")
    return fail("does not end in .obj", "--out " + path, "meshes are written as Wavefront OBJ files");
  return check_writable(path);
}

/// Makes a mesh of what was seen, and saves it. Returns the exit code.
int conclude(std::FILE* out, const ScanOptions& o, const ObjectScan& scan, const TrackOutcome& tracked) {
  // Refuse to save anything that is not a solid.
  const ObjectScan::Object* object = scan.object();
  const ScannedMesh scanned = object ? scanned_mesh(object->surface, kFine) : ScannedMesh();
  ObjectMesh checked = scanned.mesh;
  const bool solid = !checked.triangles.empty() && repair_mesh(checked, o.out).has_value();

  if (!solid) {
    if (tracked.exit_code == kExitFailure) return tracked.exit_code;  // track() has reported why
    return failed("scan-object",
                  {object ? "too little of an object was seen" : "no object was seen in or near a hand", o.track.source,
                   "hold it before the sensor, and turn it; nothing is saved"},
                  kExitFailure);
  }

  // Save it, and say what it is.
  const auto& [name, vertices, triangles] = scanned.mesh;
  const std::vector<ObjGroup> groups = {{"seen", 0}, {"closed", scanned.lids}};
  if (const auto saved = save_obj(vertices, triangles, o.out, groups); !saved)
    return failed("scan-object", saved.error(), kExitFailure);

  // Say how much was seen.
  std::fprintf(out, "%s, held in %d of %d frames\n", described(*object, scanned).c_str(), object->held, scan.frames());
  if (object->held == 0) std::fputs("no object was held, so this is the one of which most was seen\n", out);
  if (scanned.seen < kLittle) std::fputs("little was seen of it; scan it again, and turn it before the sensor\n", out);
  std::fprintf(out, "saved in %s, %zu triangles; the group \"closed\" closes what was not seen\n", o.out.c_str(),
               triangles.size());
  return tracked.stopped ? static_cast<int>(kExitOk) : tracked.exit_code;
}

int run_scan(const ScanOptions& o) {
  // Check the input before the user starts to move.
  auto config = read_configuration(o.track.config);
  if (!config) return failed("scan-object", config.error(), kExitUsage);
  config->contact.enabled = true;
  config->preprocess.margin = std::max(config->preprocess.margin, kScanMargin);
  if (const auto possible = check_output(o.out); !possible) return failed("scan-object", possible.error(), kExitUsage);

  // Track, and collect the objects.
  ObjectScan scan;
  ScanAdvice advice;
  const auto look = [&](std::span<const ObjectTrack> objects) {
    scan.add(objects);
    advice.give(scan);
  };

  TrackOptions track_options = o.track;
  track_options.saved_later = o.out;
  std::cerr << kHowToScan << std::endl;
  const auto tracked = track(track_options, *config, {}, {}, {}, look);
  if (!tracked) return failed("scan-object", tracked.error().error, tracked.error().exit_code);
  return conclude(is_standard_output(o.track.overlay) ? stderr : stdout, o, scan, *tracked);
}

}  // namespace

void add_scan_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ScanOptions>();
  ScanOptions& o = *options;
  o.track.no_publish = true;
  o.track.threads = available_cores();

  // Add options for input and output.
  CLI::App* scan =
      app.add_subcommand("scan-object", "Save the shape of an object that a hand turns as a mesh for track --object");
  add_input_options(*scan, o.track);
  scan->get_option("--source")->required();
  scan->add_option("--out", o.out, "mesh to write (OBJ, metres)")->required();
  scan->add_option("--overlay", o.track.overlay, "as for track");

  // Add options for the page, and for how the run is computed.
  add_view_options(*scan, o.track);
  add_overwrite_option(*scan, o.track.overwrite);
  scan->add_option("--lcm-url", o.track.lcm_url, "LCM network of the source lcm");
  scan->add_option("--threads", o.track.threads, "cores to use; results do not depend on it")->capture_default_str();
  scan->footer(kHowToScan);
  scan->callback([options, &exit_code] { exit_code = run_scan(*options); });
}

}  // namespace barehand
