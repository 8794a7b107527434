// Copies frames from a source to a log or folder, and reports the progress.
#include "app/record/copy_frames.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <ostream>

#include "core/repeat_filter.h"

namespace barehand {
namespace {

constexpr const char* kWaiting = "waiting";  // kind of the messages about a source without frames

/// One run of copy_frames.
class Copy {
 public:
  Copy(FrameSource& source, FrameWriter& writer, const CopyOptions& options, const Clock& clock, std::ostream& report)
      : source_(source), writer_(writer), options_(options), clock_(clock), report_(report) {}

  CopyResult run(const std::atomic<bool>& stop) {
    start_us_ = shown_us_ = clock_.steady_us();
    waiting_.admit(kWaiting);  // it is not said at once, but after the first interval
    while (!finished()) {
      if (stop) {
        result_.stopped = true;
        break;
      }
      const bool more = handle(source_.next(std::chrono::milliseconds(50)));
      if (options_.on_step) options_.on_step(result_);
      if (!more) break;
    }
    if (line_open_) report_ << "\n";
    return std::move(result_);
  }

 private:
  bool finished() const {
    const bool enough = options_.frames > 0 && result_.written >= options_.frames;
    const bool long_enough = options_.seconds > 0 && seconds_since(start_us_) >= options_.seconds;
    return enough || long_enough;
  }
  double seconds_since(std::int64_t time_us) const { return 1e-6 * static_cast<double>(clock_.steady_us() - time_us); }

  /// Returns false when copying must stop (enough frames, end of the source, or an error).
  bool handle(const SourceEvent& event) {
    if (const auto* frame = std::get_if<FramePtr>(&event)) return store(**frame);
    if (const auto* skipped = std::get_if<SkippedFrame>(&event)) return skip(skipped->error);
    if (const auto* failed = std::get_if<SourceFailed>(&event)) return end_with(failed->error);
    if (const auto* notice = std::get_if<SourceNotice>(&event)) {
      say(notice->error.message());
      return true;
    }
    if (std::holds_alternative<Timeout>(event)) return wait();
    return false;
  }

  bool store(const RgbdFrame& frame) {
    count_missing(frame);
    if (auto written = writer_.write(frame); !written) return lose(written.error());
    if (losing_) say("writing again; " + std::to_string(result_.lost) + " frames were lost so far");
    losing_ = false;
    ++result_.written;
    show();
    return true;
  }

  bool lose(const Error& error) {
    if (!source_.live()) return end_with(error);
    ++result_.lost;
    result_.lost_why = error.what;
    losing_ = true;
    if (filter_.admit("lost")) say(std::to_string(result_.lost) + " frames lost so far: " + error.message());
    return true;
  }

  /// Counts missing frames by the gaps in the frame numbers of a live source. Every sensor on a network numbers its own
  /// frames. A skipped frame also leaves a gap but is not missing; since it may be reported before its gap is seen, the
  /// totals are subtracted.
  void count_missing(const RgbdFrame& frame) {
    // Add the gap in the frame numbers of this sensor, if the source is live.
    const auto [last, first] = last_numbers_.try_emplace(frame.sensor, frame.number);
    const std::int64_t between = first ? 0 : frame.number - last->second - 1;
    last->second = frame.number;
    if (source_.live() && between > 0) gaps_ += between;

    // Subtract the skipped frames, whose gaps are counted as well.
    const std::int64_t before = result_.missing;
    result_.missing = std::max<std::int64_t>(0, gaps_ - result_.skipped);
    if (result_.missing <= before) return;

    // Count how many of them the queues of the source dropped, and tell the user.
    result_.dropped = 0;
    for (const QueueHealth& queue : source_.queues())
      if (queue.capacity > 0) result_.dropped += queue.dropped;
    if (filter_.admit("missing"))
      say(std::to_string(result_.missing) + " frames missing so far, " + std::to_string(result_.dropped) +
          " of them because frames come faster than they can be written");
  }

  bool skip(const Error& error) {
    ++result_.skipped;
    if (filter_.admit("skipped")) say("skipped: " + error.message());
    return true;
  }

  bool wait() {
    if (result_.written == 0 && waiting_.admit(kWaiting)) say("waiting for frames from " + source_.name());
    return true;
  }

  bool end_with(const Error& error) {
    result_.error = error;
    return false;
  }

  void show() {
    if (options_.quiet || seconds_since(shown_us_) < (options_.terminal ? 0.2 : 5.0)) return;
    shown_us_ = clock_.steady_us();
    std::string text = std::to_string(result_.written);
    if (options_.expected) text += " of " + std::to_string(*options_.expected);
    text += " frames";
    if (result_.skipped > 0) text += ", " + std::to_string(result_.skipped) + " skipped";
    if (result_.missing > 0) text += ", " + std::to_string(result_.missing) + " missing";
    if (result_.lost > 0) text += ", " + std::to_string(result_.lost) + " lost";
    report_ << (options_.terminal ? "\r\x1b[K" : "") << text << (options_.terminal ? "" : "\n") << std::flush;
    line_open_ = options_.terminal;
  }

  void say(const std::string& text) {
    if (line_open_) report_ << "\n";
    line_open_ = false;
    report_ << text << "\n" << std::flush;
  }

  FrameSource& source_;
  FrameWriter& writer_;
  const CopyOptions& options_;
  const Clock& clock_;
  std::ostream& report_;
  RepeatFilter filter_{clock_, 1'000'000}, waiting_{clock_, kWaitingIntervalUs, kWaitingGrowth};
  CopyResult result_;
  std::int64_t start_us_ = 0, shown_us_ = 0, gaps_ = 0;
  std::map<std::string, std::int64_t> last_numbers_;  // number of the last frame of each sensor
  bool line_open_ = false, losing_ = false;
};

}  // namespace

CopyResult copy_frames(FrameSource& source, FrameWriter& writer, const CopyOptions& options,
                       const std::atomic<bool>& stop, const Clock& clock, std::ostream& report) {
  return Copy(source, writer, options, clock, report).run(stop);
}

}  // namespace barehand
