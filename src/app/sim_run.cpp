#include "app/sim_run.h"

#include <filesystem>
#include <memory>

#include "app/frame_writer.h"
#include "core/clock.h"
#include "drivers/synthetic/synthetic_source.h"
#include "io/hand_json.h"
#include "io/pose_json.h"
#include "io/result_table.h"

namespace barehand {
namespace {

using synthetic::SyntheticSource;

/// Path of a file that goes with the recording.
std::string beside(const std::string& out, const std::string& name) {
  return is_log_path(out) ? std::filesystem::path(out).replace_extension(name).string() : out + "/" + name;
}

/// Logs get JPEG, as from a camera that streams; folders lossless colour.
Result<std::unique_ptr<FrameWriter>> make_writer(const std::string& out, double fps) {
  FrameWriterOptions options;
  options.encoding.colour = is_log_path(out) ? ColourEncoding::jpeg : ColourEncoding::png;
  options.fps = fps;
  return open_frame_writer(out, options);
}

}  // namespace

Result<std::int64_t> run_sim(const SimOptions& options,
                             const std::function<bool(std::int64_t, std::int64_t)>& progress) {
  const SystemClock clock;
  auto source = SyntheticSource::open(options.spec, clock);
  if (!source) return tl::unexpected(source.error());
  if ((*source)->live() || (*source)->remaining() < 0)
    return fail("a recording is neither live nor endless", "sim:" + options.spec, "leave out live and loop");
  auto writer = make_writer(options.out, (*source)->fps());
  if (!writer) return tl::unexpected(writer.error());
  if (auto ok = save_profile((*source)->profile(), beside(options.out, "hand.json")); !ok)
    return tl::unexpected(ok.error());
  auto truth = TableWriter::create(beside(options.out, "truth.csv"));
  if (!truth) return tl::unexpected(truth.error());
  const std::int64_t all = (*source)->remaining();
  std::int64_t done = 0;
  while (done < all) {
    const SourceEvent event = (*source)->next(std::chrono::milliseconds(0));
    const auto* frame = std::get_if<FramePtr>(&event);
    if (!frame) break;
    if (auto ok = (*writer)->write(**frame); !ok) return tl::unexpected(ok.error());
    const auto& truths = (*source)->truth();
    if (!truths.empty() && truths.back().number == (*frame)->number)
      if (auto ok = truth->write(truths.back()); !ok) return tl::unexpected(ok.error());
    if (done == 0)
      if (auto ok = save_pose((*source)->pose(), beside(options.out, "start_pose.json")); !ok)
        return tl::unexpected(ok.error());
    ++done;
    if (!progress(done, all)) break;
  }
  return done;
}

}  // namespace barehand
