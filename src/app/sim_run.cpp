#include "app/sim_run.h"

#include <filesystem>
#include <memory>

#include "core/clock.h"
#include "drivers/lcm/frame_codec.h"
#include "drivers/lcm/wire.h"
#include "drivers/synthetic/synthetic_source.h"
#include "io/hand_json.h"
#include "io/lcm_log_writer.h"
#include "io/pose_json.h"
#include "io/recording_writer.h"
#include "io/result_table.h"

namespace barehand {
namespace {

using synthetic::SyntheticSource;

/// Where frames go.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  virtual Result<void> write(const RgbdFrame& frame) = 0;
};

class FolderWriter : public FrameWriter {
 public:
  explicit FolderWriter(RecordingWriter writer) : writer_(std::move(writer)) {}
  Result<void> write(const RgbdFrame& frame) override {
    const auto number = writer_.write(frame);
    if (!number) return tl::unexpected(number.error());
    return {};
  }

 private:
  RecordingWriter writer_;
};

class LogWriter : public FrameWriter {
 public:
  explicit LogWriter(std::unique_ptr<LcmLogWriter> log) : log_(std::move(log)) {}
  Result<void> write(const RgbdFrame& frame) override {
    FrameEncoding encoding;
    encoding.colour = ColourEncoding::jpeg;
    const auto message = encode_frame(frame, encoding);
    if (!message) return tl::unexpected(message.error());
    return log_->send("RGBD_FRAME", encode_message(*message), frame.utime);
  }

 private:
  std::unique_ptr<LcmLogWriter> log_;
};

bool is_log(const std::string& out) { return out.ends_with(".lcmlog"); }

/// Path of a file that goes with the recording.
std::string beside(const std::string& out, const std::string& name) {
  return is_log(out) ? out.substr(0, out.size() - 6) + name : out + "/" + name;  // 6: "lcmlog"
}

Result<std::unique_ptr<FrameWriter>> make_writer(const std::string& out, double fps) {
  if (is_log(out)) {
    auto log = LcmLogWriter::create(out, false);
    if (!log) return tl::unexpected(log.error());
    return std::make_unique<LogWriter>(std::move(*log));
  }
  RecordingWriter::Options options;
  options.fps = fps;
  auto writer = RecordingWriter::create(out, options);
  if (!writer) return tl::unexpected(writer.error());
  return std::make_unique<FolderWriter>(std::move(*writer));
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
