#include "sensor/frame_order.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/format.h"

namespace barehand {
namespace {

// Checks the order and the unit of time stamps, and numbers the frames.

constexpr std::size_t kSteps = 15;  // intervals between frames from which the unit of the stamps is checked
// Intervals that suffice for this check at the end of a short recording.
constexpr std::size_t kFewestSteps = 2;
constexpr std::int64_t kUnusedRatio = 10;                       // warn if more than 1 of this many frames was not used
constexpr std::int64_t kLargestNumber = 1'000'000'000'000'000;  // larger frame numbers are damaged

/// Shortest and longest plausible interval between two frames [us]: 2000 and 0.5 frames per second.
constexpr double kShortest = 500, kLongest = 2'000'000;

double seconds(std::int64_t us) { return 1e-6 * static_cast<double>(us); }

std::string in_unit(StampUnit unit) {
  return unit == StampUnit::seconds ? "stamps are in seconds" : "utime is in microseconds";
}

/// Explains a backward step of the time [s] that matches the overflow of a 32-bit counter; "" for any other step.
std::string overflow(double step_back) {
  constexpr double kRange = 4294967296.0,
                   kSlack = 10;  // number of values of the counter, and tolerance of the step [s]
  for (const auto& [unit, per_second] : {std::pair("microseconds", 1e6), std::pair("milliseconds", 1e3)})
    if (std::abs(step_back - kRange / per_second) < kSlack)
      return std::string(", as a counter of ") + unit + " with 32 bits does when it overflows";
  return "";
}

}  // namespace

std::string too_late(double stamp, StampUnit unit) {
  // A typical time of today [s since the epoch]; a plausible time is at most this factor smaller or larger (the years
  // 1972 to about 3000).
  constexpr double kNow = 1.7e9, kFactor = 20;

  // A guess is a unit of time, and how many of it are in one second.
  struct Guess {
    const char* name;
    double per_second;
  };
  const double unit_per_second = unit == StampUnit::seconds ? 1 : 1e6;

  // Choose the first unit with which the time would be plausible.
  for (const Guess& guess : {Guess{"milliseconds", 1e3}, Guess{"microseconds", 1e6}, Guess{"nanoseconds", 1e9}}) {
    const double since_epoch = std::abs(stamp) / guess.per_second;
    if (guess.per_second > unit_per_second && since_epoch > kNow / kFactor && since_epoch < kNow * kFactor)
      return std::string("this looks like ") + guess.name + " since the epoch, but " + in_unit(unit) +
             formatted(": divide it by %.0f", guess.per_second / unit_per_second);
  }
  return in_unit(unit) + ", and no recording is from that time";
}

std::string unlikely_steps(std::vector<std::int64_t> steps, std::int64_t last, StampUnit unit) {
  if (steps.size() < kFewestSteps) return "";

  // Find the typical interval between two frames: the median, which a few gaps do not change.
  const auto [least, most] = std::ranges::minmax(steps);
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  const auto typical = static_cast<double>(steps[steps.size() / 2]);
  const double one = unit == StampUnit::seconds ? 1e6 : 1;

  // Guess what the stamps are if their interval is implausible.
  std::string like;
  const bool whole = last % static_cast<std::int64_t>(one) == 0;
  if (whole && least == most && typical == one) {
    like = "frame numbers: divide them by the frame rate";
  } else if (typical > kLongest) {
    // Find out by which power of 1000 the interval is too long.
    const int thousands = typical < 1e3 * kLongest ? 1 : typical < 1e6 * kLongest ? 2 : 3;
    constexpr std::array<const char*, 5> kUnits = {"", "milliseconds", "microseconds", "nanoseconds", ""};
    const int index = (unit == StampUnit::seconds ? 0 : 2) + thousands;
    if (index < 4)
      like = std::string(kUnits[static_cast<std::size_t>(index)]) + formatted(": divide them by 1e%d", 3 * thousands);
  } else if (typical < kShortest) {
    like = unit == StampUnit::microseconds && typical > kShortest / 1e3 ? "milliseconds: multiply them by 1000"
                                                                        : "another unit";
  }

  if (like.empty()) return "";
  return in_unit(unit) + formatted(", and the frames are %.6g s apart: these look like ", 1e-6 * typical) + like;
}

Result<std::int64_t> FrameOrder::number(std::int64_t utime, std::int64_t number) {
  // Reject a time that is out of range.
  ++frames_;
  if (utime > kLatestUtime || utime < -kLatestUtime) {
    const auto stamp = static_cast<double>(utime);
    return fail(formatted("its time is %.6g", unit_ == StampUnit::seconds ? 1e-6 * stamp : stamp), "",
                too_late(unit_ == StampUnit::seconds ? 1e-6 * stamp : stamp, unit_));
  }

  // A time that is not later is an error, unless it is so much earlier that the source has started again.
  if (begun_ && utime <= last_utime_) {
    if (last_utime_ - utime < kRestart) {
      ++unused_;
      const char* const remedy = utime == last_utime_ ? "every frame needs a time of its own" : "";
      return fail("its time is not later than that of the frame before", "", remedy);
    }
    check_restart(utime, number);
  } else if (begun_ && !steps_checked_) {
    // Collect the first intervals, from which a wrong unit can be recognised.
    steps_.push_back(utime - last_utime_);
    if (steps_.size() >= kSteps) check_steps();
  }

  // Shift the number if the source counts from its start again, and store the frame as the last one.
  number = going_on(number);
  begun_ = true;
  last_utime_ = utime;
  last_number_ = number;
  return number;
}

std::int64_t FrameOrder::going_on(std::int64_t number) {
  // A message may contain any number: numbers that could overflow when shifted are passed on unchanged.
  if (number > kLargestNumber || number < -kLargestNumber) return number;
  if (begun_ && number + number_shift_ <= last_number_ && last_number_ <= kLargestNumber)
    number_shift_ = last_number_ + 1 - number;
  return number + number_shift_;
}

void FrameOrder::check_restart(std::int64_t utime, std::int64_t number) {
  if (said_restart_) return;
  said_restart_ = true;
  const double back = seconds(last_utime_) - seconds(utime);
  warnings_.push_back(formatted("at frame %lld the time goes back by %.3f s%s: it is taken as a new start",
                                static_cast<long long>(number), back, overflow(back).c_str()));
}

void FrameOrder::check_steps() {
  if (steps_checked_ || steps_.size() < kFewestSteps) return;
  steps_checked_ = true;

  // Warn, but use the stamps as they stand.
  const std::string unlikely = unlikely_steps(std::exchange(steps_, {}), last_utime_, unit_);
  if (!unlikely.empty())
    warnings_.push_back(unlikely + ". They are used as they stand, so that motion and time limits are wrong");
}

std::vector<std::string> FrameOrder::take_warnings() { return std::exchange(warnings_, {}); }

std::vector<std::string> FrameOrder::take_last_warnings() {
  check_steps();
  if (unused_ * kUnusedRatio > frames_)
    warnings_.push_back(
        formatted("%lld of %lld frames are not later than the frame before them and are not used: are "
                  "they in order of time?",
                  static_cast<long long>(unused_), static_cast<long long>(frames_)));
  return take_warnings();
}

}  // namespace barehand
