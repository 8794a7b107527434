// Runs `barehand sim`: renders a sequence into a recording or a log, with its truth.
#include "app/sim/sim_run.h"

#include <filesystem>
#include <memory>

#include "app/record/frame_writer.h"
#include "app/shared/outputs.h"
#include "app/sim/object_files.h"
#include "core/both.h"
#include "core/clock.h"
#include "drivers/synthetic/synthetic_source.h"
#include "io/hand/hand_json.h"
#include "io/hand/path_of_hand.h"
#include "io/hand/pose_json.h"
#include "io/hand/result_table.h"

namespace barehand {
namespace {

using synthetic::SimulatedHand;
using synthetic::SyntheticSource;

/// Path of a file that belongs to the recording.
std::string beside(const std::string& out, const std::string& name) {
  return is_file_path(out) ? std::filesystem::path(out).replace_extension(name).string() : out + "/" + name;
}

/// Logs get JPEG colour, as from a camera that streams; folders get lossless colour.
Result<std::unique_ptr<FrameWriter>> make_writer(const std::string& out, double fps, bool overwrite) {
  FrameWriterOptions options;
  options.encoding.colour = is_file_path(out) ? ColourEncoding::jpeg : ColourEncoding::png;
  options.fps = fps;
  options.overwrite = overwrite;
  return open_frame_writer(out, options);
}

/// Where the files about the grasped object are written.
ObjectFiles::Paths object_paths(const std::string& out, const std::string& name,
                                const std::vector<SimulatedHand>& hands) {
  ObjectFiles::Paths paths{beside(out, name + ".obj"), beside(out, "objects.csv"), beside(out, "grasps.csv"), {}};
  for (std::size_t k = 0; k < hands.size(); ++k)
    paths.contacts.push_back(
        path_of_hand(beside(out, "contacts.csv"), static_cast<int>(k), hands[k].profile.handedness));
  return paths;
}

/// Checks that the log or recording, and the files that belong to it, may be written.
Result<void> check_written(const SimOptions& options, const SyntheticSource& source) {
  std::vector<Output> outputs{
      {"--out", options.out, is_file_path(options.out) ? Output::Kind::file : Output::Kind::recording}};
  if (auto good = check_ending(outputs[0], is_file_path(options.out), kFileEndings); !good) return good;

  // Add the files of each hand.
  const std::vector<SimulatedHand>& hands = source.hands();
  for (std::size_t k = 0; k < hands.size(); ++k)
    for (const char* name : {"hand.json", "truth.csv", "start_pose.json"})
      outputs.push_back(
          {"--out", path_of_hand(beside(options.out, name), static_cast<int>(k), hands[k].profile.handedness)});

  // Add the files of the object, if one is grasped.
  if (source.grasped()) {
    ObjectFiles::Paths paths = object_paths(options.out, source.grasped()->name(), hands);
    outputs.push_back({"--out", std::move(paths.mesh)});
    outputs.push_back({"--out", std::move(paths.poses)});
    outputs.push_back({"--out", std::move(paths.grasps)});
    for (std::string& path : paths.contacts) outputs.push_back({"--out", std::move(path)});
  }
  return check_outputs({}, {}, outputs, options.overwrite);
}

/// The files about one hand: its profile, its truth, and its pose in the first frame if it is seen there.
class HandFiles {
 public:
  /// Creates the files of the k-th hand.
  static Result<HandFiles> create(const SimOptions& options, int k, const HandProfile& profile) {
    const auto path = [&](const char* name) { return path_of_hand(beside(options.out, name), k, profile.handedness); };
    if (auto ok = save_profile(profile, path("hand.json")); !ok) return tl::unexpected(ok.error());
    auto truth = TableWriter::create(path("truth.csv"), options.overwrite);
    if (!truth) return tl::unexpected(truth.error());
    return HandFiles(std::move(*truth), path("start_pose.json"));
  }
  /// Writes what belongs to the frame with this number.
  Result<void> write(const SimulatedHand& hand, std::int64_t number) {
    if (!hand.truth) return {};  // the hand is not in view
    if (number == 0)
      if (auto ok = save_pose(hand.pose, start_pose_); !ok) return ok;
    return truth_.write(*hand.truth);
  }
  Result<void> finish() { return truth_.finish(); }

 private:
  HandFiles(TableWriter truth, std::string start_pose) : truth_(std::move(truth)), start_pose_(std::move(start_pose)) {}

  TableWriter truth_;
  std::string start_pose_;
};

Result<std::vector<HandFiles>> create_hand_files(const SimOptions& options, const std::vector<SimulatedHand>& hands) {
  std::vector<HandFiles> files;
  for (const SimulatedHand& hand : hands) {
    auto created = HandFiles::create(options, static_cast<int>(files.size()), hand.profile);
    if (!created) return tl::unexpected(created.error());
    files.push_back(std::move(*created));
  }
  return files;
}

/// The files about the grasped object; none if nothing is grasped.
Result<std::optional<ObjectFiles>> create_object_files(const SimOptions& options, const SyntheticSource& source) {
  if (!source.grasped()) return std::nullopt;
  return ObjectFiles::create(object_paths(options.out, source.grasped()->name(), source.hands()), source,
                             options.overwrite);
}

}  // namespace

Result<std::int64_t> run_sim(const SimOptions& options,
                             const std::function<bool(std::int64_t, std::int64_t)>& progress) {
  // Open the source. A recording must end.
  const SystemClock clock;
  auto source = SyntheticSource::open(options.spec, clock);
  if (!source) return tl::unexpected(source.error());

  if ((*source)->live() || (*source)->remaining() < 0)
    return fail("a recording is neither live nor endless", "sim:" + options.spec, "leave out live and loop");
  if (const auto free = check_written(options, **source); !free) return tl::unexpected(free.error());
  auto writer = make_writer(options.out, (*source)->fps(), options.overwrite);
  if (!writer) return tl::unexpected(writer.error());
  auto hand_files = create_hand_files(options, (*source)->hands());
  if (!hand_files) return tl::unexpected(hand_files.error());
  auto object_files = create_object_files(options, **source);
  if (!object_files) return tl::unexpected(object_files.error());

  // Render and write frame by frame.
  const std::int64_t all = (*source)->remaining();
  std::int64_t done = 0;
  while (done < all) {
    const SourceEvent event = (*source)->next(std::chrono::milliseconds(0));
    const auto* frame = std::get_if<FramePtr>(&event);
    if (!frame) break;

    // Write the frame, and the truth about each hand and the grasped object.
    if (auto ok = (*writer)->write(**frame); !ok) return tl::unexpected(ok.error());
    for (std::size_t i = 0; i < hand_files->size(); ++i)
      if (auto ok = (*hand_files)[i].write((*source)->hands()[i], (*frame)->number); !ok)
        return tl::unexpected(ok.error());
    if (*object_files)
      if (auto ok = (*object_files)->write(**source, (*frame)->utime); !ok) return tl::unexpected(ok.error());
    ++done;
    if (!progress(done, all)) break;
  }

  if (done == 0) return fail("no frame was rendered, so nothing is written", "sim:" + options.spec);
  auto finished = (*writer)->finish();
  for (HandFiles& files : *hand_files) finished = both(std::move(finished), files.finish());
  if (*object_files) finished = both(std::move(finished), (*object_files)->finish());
  if (!finished) return tl::unexpected(finished.error());
  return done;
}

}  // namespace barehand
