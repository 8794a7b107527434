#include "app/sim_run.h"

#include <filesystem>
#include <memory>

#include "app/frame_writer.h"
#include "core/clock.h"
#include "drivers/synthetic/synthetic_source.h"
#include "io/hand_json.h"
#include "io/path_of_hand.h"
#include "io/pose_json.h"
#include "io/result_table.h"

namespace barehand {
namespace {

using synthetic::SimulatedHand;
using synthetic::SyntheticSource;

/// Path of a file that belongs to the recording.
std::string beside(const std::string& out, const std::string& name) {
  return is_log_path(out) ? std::filesystem::path(out).replace_extension(name).string() : out + "/" + name;
}

/// Logs get JPEG images, as from a camera that streams; folders get lossless colour images.
Result<std::unique_ptr<FrameWriter>> make_writer(const std::string& out, double fps) {
  FrameWriterOptions options;
  options.encoding.colour = is_log_path(out) ? ColourEncoding::jpeg : ColourEncoding::png;
  options.fps = fps;
  return open_frame_writer(out, options);
}

/// The files about one hand: its profile, its truth and, if it is visible in the first frame, its pose there.
class HandFiles {
 public:
  /// Creates the files of the k-th hand.
  static Result<HandFiles> create(const std::string& out, int k, const HandProfile& profile) {
    const auto path = [&](const char* name) { return path_of_hand(beside(out, name), k, profile.handedness); };
    if (auto ok = save_profile(profile, path("hand.json")); !ok) return tl::unexpected(ok.error());
    auto truth = TableWriter::create(path("truth.csv"));
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

 private:
  HandFiles(TableWriter truth, std::string start_pose) : truth_(std::move(truth)), start_pose_(std::move(start_pose)) {}

  TableWriter truth_;
  std::string start_pose_;
};

Result<std::vector<HandFiles>> create_hand_files(const std::string& out, const std::vector<SimulatedHand>& hands) {
  std::vector<HandFiles> files;
  for (const SimulatedHand& hand : hands) {
    auto created = HandFiles::create(out, static_cast<int>(files.size()), hand.profile);
    if (!created) return tl::unexpected(created.error());
    files.push_back(std::move(*created));
  }
  return files;
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

  // Open the outputs.
  auto writer = make_writer(options.out, (*source)->fps());
  if (!writer) return tl::unexpected(writer.error());
  auto hand_files = create_hand_files(options.out, (*source)->hands());
  if (!hand_files) return tl::unexpected(hand_files.error());

  // Render and write frame by frame.
  const std::int64_t all = (*source)->remaining();
  std::int64_t done = 0;
  while (done < all) {
    const SourceEvent event = (*source)->next(std::chrono::milliseconds(0));
    const auto* frame = std::get_if<FramePtr>(&event);
    if (!frame) break;

    // The frame, and the truth about each hand.
    if (auto ok = (*writer)->write(**frame); !ok) return tl::unexpected(ok.error());
    for (std::size_t i = 0; i < hand_files->size(); ++i)
      if (auto ok = (*hand_files)[i].write((*source)->hands()[i], (*frame)->number); !ok)
        return tl::unexpected(ok.error());
    ++done;
    if (!progress(done, all)) break;
  }
  return done;
}

}  // namespace barehand
