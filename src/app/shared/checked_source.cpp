// Checks the frames of a source and reports what looks wrong in them.
#include "app/shared/checked_source.h"

#include "core/format.h"
#include "sensor/camera_warnings.h"
#include "sensor/picture_check.h"

namespace barehand {
namespace {

constexpr std::int64_t kRepeatEvery = 10'000'000;  // a problem of one kind is reported at most once in this time [us]
constexpr std::int64_t kStillFor = 1'000'000;      // an unchanged image of a recording is reported after this time [us]
constexpr int kStillFrames = 10;                   // and only if at least this number of frames have this image

double seconds(std::int64_t us) { return 1e-6 * static_cast<double>(us); }

}  // namespace

CheckedSource::CheckedSource(std::unique_ptr<FrameSource> source, const DepthLimits& limits, const Clock& clock)
    : source_(std::move(source)), limits_(limits), filter_(clock, kRepeatEvery) {}

SourceEvent CheckedSource::take_next() {
  SourceEvent event = std::move(to_come_.front());
  to_come_.pop_front();
  return event;
}

SourceEvent CheckedSource::next(std::chrono::milliseconds patience) {
  if (!to_come_.empty()) return take_next();
  SourceEvent event = source_->next(patience);
  if (const auto* frame = std::get_if<FramePtr>(&event)) {
    if (!check_frame(*frame)) return take_next();
  } else if (std::holds_alternative<EndOfStream>(event) && range_) {
    if (const auto warning = range_->finish()) say("range", *warning);
  }
  if (to_come_.empty()) return event;
  to_come_.push_back(std::move(event));
  return take_next();
}

/// Returns whether the frame is to be used. Messages about it are queued before it.
bool CheckedSource::check_frame(const FramePtr& frame) {
  if (!before_ || !(before_->camera == frame->camera) || before_->depth_unit != frame->depth_unit) {
    check_camera(*frame);
    range_.emplace(limits_);
  }
  if (!frame->colour_fault.empty())
    say("colour", "colour is not used: " + frame->colour_fault, "tracking continues with depth alone");
  if (!check_image(frame)) return false;
  if (const auto warning = range_->add(*frame)) say("range", *warning);
  before_ = frame;
  return true;
}

void CheckedSource::check_camera(const RgbdFrame& frame) {
  for (const std::string& warning : camera_warnings(frame.camera)) say("camera", warning);
}

bool CheckedSource::check_image(const FramePtr& frame) {
  // Drop a live image that is noise or repeats the previous one, and report it.
  const DepthFault fault = check_depth(frame->depth, before_ ? &before_->depth : nullptr);
  const bool still = fault == DepthFault::repeated;
  if (live() && (still || fault == DepthFault::senseless)) {
    to_come_.push_back(
        SkippedFrame{{still ? "the depth image is identical to the previous one, but has a new time stamp"
                            : "the depth image is noise",
                      name(), "check the sensor, or the program that sends its frames"}});
    return false;
  }

  // In a recording, keep such an image, but report it.
  if (fault == DepthFault::senseless)
    say("noise",
        formatted("the depth image of frame %lld is noise: neighbouring pixels are unrelated",
                  static_cast<long long>(frame->number)),
        "is it a 16-bit image with its bytes in the right order?");
  check_stillness(*frame, still);
  return true;
}

/// Reports a recording whose depth image stays the same. The noise of a sensor never repeats, so the sensor had
/// stopped. In a simulated recording, however, the hand may just be at rest, so this is a notice, not an error.
void CheckedSource::check_stillness(const RgbdFrame& frame, bool still) {
  // A new image ends the time in which the depth was frozen.
  if (!still) {
    still_since_.reset();
    return;
  }
  if (!still_since_) {
    still_since_ = before_;
    still_frames_ = 1;
  }

  // Report the frozen image once it has lasted for kStillFrames frames and for the time kStillFor.
  const std::int64_t lasting = std::abs(frame.utime - still_since_->utime);
  if (++still_frames_ < kStillFrames || lasting < kStillFor) return;
  say("still",
      formatted("the depth image is frozen: from frame %lld to %lld, for %.3g s, all depth images are identical",
                static_cast<long long>(still_since_->number), static_cast<long long>(frame.number), seconds(lasting)),
      "the noise of a sensor never repeats: had it stopped?");
}

void CheckedSource::say(const std::string& kind, const std::string& what, const std::string& remedy) {
  const auto suppressed = filter_.admit(kind);
  if (!suppressed.has_value()) return;
  const std::string more = *suppressed > 0 ? " (and " + std::to_string(*suppressed) + " more like this)" : "";
  to_come_.push_back(SourceNotice{{what + more, name(), remedy}});
}

}  // namespace barehand
