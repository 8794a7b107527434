// Reads an open OpenNI2 sensor: pairs depth with colour, and converts and checks the time stamps.
#include "drivers/openni2/live_session.h"

#include <algorithm>

#include "core/format.h"
#include "drivers/openni2/frames/pixels.h"
#include "drivers/openni2/frames/video_modes.h"

namespace barehand {
namespace {

constexpr std::int64_t kReadWait = 50'000;       // longest wait for an image [us]; limits the time that stopping takes
constexpr double kFirstDepth = 3;                // time that a sensor may need for its first depth image [s]
constexpr double kPeriods = 5;                   // frame periods that a stall lasts at least, for slow sensors
constexpr std::int64_t kColourGone = 1'000'000;  // time without colour after which colour counts as stopped [us]
constexpr int kOutOfStep = 10;  // frames in a row without their colour that prove that pairing does not work
constexpr int kDepthAlone = 5;  // depth images after which colour is missing; fewer may just have come after a stall
constexpr std::int64_t kSayAfter = 1'000'000;  // a fault of the images is reported when it has lasted this long [us]
constexpr std::int64_t kClockSet = 100'000;    // a larger change of the host's clock means that it was set [us]

constexpr const char* kReplug =
    "it is reopened; if this continues, reconnect it to a USB port that no other device shares";

/// Host time at the zero of the steady clock [us]. The process may be interrupted between reading the two clocks, so
/// the quickest of several attempts counts.
std::int64_t host_epoch(const Clock& clock) {
  std::int64_t epoch = 0, quickest = INT64_MAX;
  for (int i = 0; i < 4 && quickest > 20; ++i) {
    const std::int64_t before = clock.steady_us(), utime = clock.utime(), after = clock.steady_us();
    if (after - before >= quickest) continue;
    quickest = after - before;
    epoch = utime - before - quickest / 2;
  }
  return epoch;
}

}  // namespace

LiveSession::LiveSession(std::unique_ptr<OpenNiSensor> sensor, const OpenNiParams& params, LiveOutput& output,
                         const Clock& clock, const std::atomic<bool>& stop)
    : sensor_(std::move(sensor)),
      params_(params),
      output_(output),
      clock_(clock),
      stop_(stop),
      period_us_(1'000'000 / std::max(1, sensor_->depth_mode().getFps())),
      pair_wanted_(sensor_->paired()),
      pairing_(period_us_),
      now_us_(clock.steady_us()),
      last_depth_us_(now_us_),
      last_colour_us_(now_us_) {
  output_.restart_numbers();
}

std::optional<LiveSession::Loss> LiveSession::step() {
  auto picture = sensor_->read(std::chrono::milliseconds(std::max<std::int64_t>(1, wait_us() / 1000)));
  if (stop_) return std::nullopt;
  now_us_ = clock_.steady_us();
  if (picture) take(std::move(*picture));
  if (auto pair = pairing_.due(now_us_)) deliver(*pair);
  if (sensor_->has_colour()) watch_colour();
  return loss();
}

std::int64_t LiveSession::wait_us() const {
  const auto due = pairing_.due_at(now_us_);
  return due ? std::clamp<std::int64_t>(*due - now_us_, 0, kReadWait) : kReadWait;
}

void LiveSession::take(OpenNiSensor::Picture picture) {
  Pairing::Stamped stamped{static_cast<std::int64_t>(picture.frame.getTimestamp()), now_us_, picture.frame};
  if (picture.colour) {
    if (pairing_held_all_ && any_depth_ && !colour_missing_) resume_step();  // both cameras deliver images again
    last_colour_us_ = now_us_;
    depth_since_colour_ = 0;
    if (auto pair = pairing_.add_colour(std::move(stamped))) deliver(*pair);
  } else {
    last_depth_us_ = now_us_;
    any_depth_ = true;
    ++depth_since_colour_;
    if (auto pair = pairing_.add_depth(std::move(stamped))) deliver(*pair);
  }
}

void LiveSession::deliver(const Pairing::Pair& pair) {
  // Number the frame and compute its capture time.
  const openni::VideoFrameRef& depth = pair.depth.picture;
  auto frame = output_.frame();
  frame->number = output_.number(depth.getFrameIndex());
  stamp(pair.depth, *frame);

  // Check the depth image.
  if (!complete(depth, sensor_->depth_mode(), 2)) return report_depth_fault(DepthFault::incomplete);
  copy_depth(depth, sensor_->mirrored(false), frame->depth);
  const DepthFault fault = check_depth(frame->depth, before_ ? &before_->depth : nullptr);
  report_depth_fault(fault);
  if (fault != DepthFault::none && fault != DepthFault::empty) return;

  // Add colour, and deliver.
  add_colour(pair.colour, *frame);
  verify_step(pair.colour.has_value());
  frame->camera = sensor_->camera();
  frame->depth_unit = depth_unit(sensor_->depth_mode().getPixelFormat());
  before_ = frame;
  output_.put(std::move(frame));
}

void LiveSession::stamp(const Pairing::Stamped& depth, RgbdFrame& frame) {
  // Map the sensor's time stamp to the host's steady clock.
  const auto mapped = device_clock_.map(depth.device_us, depth.arrival_us);
  if (mapped.jumped_by)
    output_.notice("sensor clock",
                   formatted("the sensor's clock jumped by %+.3f s; the time stamps are aligned with it again",
                             1e-6 * static_cast<double>(*mapped.jumped_by)));

  // Convert to time since the epoch; report when the host's clock was set.
  const std::int64_t epoch = host_epoch(clock_);
  if (epoch_us_ && std::abs(epoch - *epoch_us_) > kClockSet)
    output_.notice("host clock", formatted("this machine's clock was set by %+.3f s; the time stamps follow it",
                                           1e-6 * static_cast<double>(epoch - *epoch_us_)));
  epoch_us_ = epoch;
  frame.utime = epoch + mapped.host_us - static_cast<std::int64_t>(1e6 * params_.latency);
}

void LiveSession::add_colour(const std::optional<openni::VideoFrameRef>& picture, RgbdFrame& frame) {
  // Leave colour out if it is not usable.
  const openni::VideoMode& mode = sensor_->colour_mode();
  frame.colour_fault = picture ? "it is incomplete" : "";  // if there is none, watch_colour() reports it
  if (!picture || !complete(*picture, mode, colour_bytes_per_pixel(mode.getPixelFormat()))) {
    frame.colour.reset(0, 0);
    return;
  }
  frame.colour_fault.clear();

  // Report colour that stays black.
  copy_colour(*picture, sensor_->mirrored(true), frame.colour);
  const auto* pixels = frame.colour.data();
  const bool black = std::all_of(pixels, pixels + frame.colour.size(), [](const Rgb& p) { return p == Rgb{}; });
  if (!black) black_since_us_ = 0;
  if (black && black_since_us_ == 0) black_since_us_ = now_us_;
  if (black && now_us_ - black_since_us_ > kSayAfter)
    output_.notice("black", "the colour image is black; tracking continues with depth alone",
                   "uncover the lens or turn on the light");
}

void LiveSession::verify_step(bool matched) {
  // OpenNI2 may report the streams as paired although the two cameras do not expose together, so count the frames with
  // and without their colour.
  const bool colour_runs = now_us_ - last_colour_us_ < kColourGone / 4;
  in_step_ += matched && sensor_->paired();
  out_of_step_ = matched || !colour_runs || !sensor_->paired() ? 0 : out_of_step_ + 1;
  if (out_of_step_ >= kOutOfStep) give_up_step();
}

void LiveSession::pair_again() {
  in_step_ = 0;
  if (pair_wanted_ && pairings_left_-- > 0) sensor_->pair_streams(true);
}

/// Call when both cameras deliver again after pairing was switched off because no depth arrived: either the sensor was
/// slow, or pairing had blocked both streams.
void LiveSession::resume_step() {
  pairing_held_all_ = false;
  if (pairings_left_ < kPairings && in_step_ < kOutOfStep) return give_up_step();  // pairing blocked the streams again
  pair_again();
}

void LiveSession::give_up_step() {
  out_of_step_ = 0;
  pair_wanted_ = pairing_held_all_ = false;
  sensor_->pair_streams(false);
  output_.notice(
      "step",
      "depth and colour are not synchronised although the sensor reports that they are; they are paired by time stamp");
}

void LiveSession::report_depth_fault(DepthFault fault) {
  // Note since when this fault has lasted.
  if (fault != fault_) fault_since_us_ = now_us_;
  fault_ = fault;

  // Report an empty image only after some time, since it may be correct.
  switch (fault) {
    case DepthFault::none:
      break;
    case DepthFault::empty:  // the image is valid, so tracking continues without a hand
      if (now_us_ - fault_since_us_ > kSayAfter)
        output_.notice("empty", "no pixel has depth", "uncover the lens, and check that something is within its range");
      break;

    // Skip images that cannot be used.
    case DepthFault::repeated:
      output_.skip("the depth image is identical to the previous one", kReplug);
      break;
    case DepthFault::senseless:
      output_.skip("the depth image is noise", kReplug);
      break;
    case DepthFault::incomplete:
      output_.skip("the depth image is incomplete", kReplug);
      break;
  }
}

void LiveSession::watch_colour() {
  // Switch pairing off if a colour camera that has stopped may block the paired depth stream.
  const bool missing = now_us_ - last_colour_us_ > kColourGone && depth_since_colour_ >= kDepthAlone;
  if (sensor_->paired() && depth_missing_for(0.5)) {
    sensor_->pair_streams(false);
    pairing_held_all_ = true;
  }

  // Report when colour stops and when it returns.
  if (missing && !colour_missing_) {
    colour_missing_ = true;
    pairing_held_all_ = false;
    output_.notice("colour stopped", "no more colour images arrive; tracking continues with depth alone",
                   "reconnect the sensor when convenient: without colour, skin is harder to distinguish from objects");
  } else if (!missing && colour_missing_) {
    colour_missing_ = false;
    output_.notice("colour is back", "colour images arrive again", "", false);

    // Pair the streams again, unless this was tried too often.
    pair_again();
  }
}

bool LiveSession::depth_missing_for(double factor) const {
  const double patience = std::max(any_depth_ ? params_.stall_timeout : std::max(params_.stall_timeout, kFirstDepth),
                                   1e-6 * kPeriods * static_cast<double>(period_us_));
  return 1e-6 * static_cast<double>(now_us_ - last_depth_us_) > factor * patience;
}

std::optional<LiveSession::Loss> LiveSession::loss() {
  // Report a loss if the sensor sends no depth.
  if (depth_missing_for(1)) {
    const double seconds = 1e-6 * static_cast<double>(now_us_ - last_depth_us_);
    return Loss{"stalled", formatted("stalled: no depth for %.1f s, and no error", seconds), kReplug};
  }

  // Report a loss if all depth images have been useless for too long.
  const bool useless =
      fault_ == DepthFault::repeated || fault_ == DepthFault::senseless || fault_ == DepthFault::incomplete;
  const double seconds = 1e-6 * static_cast<double>(now_us_ - fault_since_us_);
  if (!useless || seconds < params_.reopen_after) return std::nullopt;
  const char* what = fault_ == DepthFault::repeated    ? "frozen: the same depth image"
                     : fault_ == DepthFault::senseless ? "delivers noise instead of depth"
                                                       : "delivers incomplete depth images";
  return Loss{"useless", formatted("%s for %.1f s", what, seconds), kReplug};
}

}  // namespace barehand
