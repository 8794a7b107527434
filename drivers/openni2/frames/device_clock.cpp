// Converts a sensor's time stamps to the host's clock.
#include "drivers/openni2/frames/device_clock.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

constexpr double kWindow = 1e6;            // duration of a window [us]
constexpr std::size_t kMostMarks = 60;     // 60 windows follow a drift that changes with temperature within a minute
constexpr std::size_t kMarksForDrift = 5;  // number of marks from which on the drift is fitted; fewer show jitter
constexpr double kMaxDrift = 2e-3;         // largest drift that is fitted; quartz clocks are better
constexpr double kEarly = 50e3;  // a frame that arrives this long [us] before its exposure shows that the clock was set
constexpr double kLearning = 2e6;  // in the first part [us], 10 * kEarly is allowed: all arrivals may have been late
// If all frames arrive later than kLate [us] for kLatePatience [us], they are not late: the sensor's clock was set.
constexpr double kLate = 50e3, kLatePatience = 3e6;

}  // namespace

DeviceClock::Mapped DeviceClock::map(std::int64_t device_us, std::int64_t arrival_us) {
  // The first frame starts the mapping, and a jump of the sensor's clock restarts it.
  Mapped mapped{arrival_us};
  if (!begun_) {
    begin(device_us, arrival_us);
  } else {
    // Compare the sensor's clock with that of the host, both counted from the first frame.
    const Mark mark{static_cast<double>(device_us - first_device_),
                    static_cast<double>((arrival_us - first_arrival_) - (device_us - first_device_))};

    // Restart the mapping after a jump; otherwise fit it to this frame as well.
    if (device_us <= last_device_ || jumped(mark)) {
      mapped.jumped_by = (device_us - last_device_) - (arrival_us - last_arrival_);
      begin(device_us, arrival_us);
    } else {
      take_in(mark);
      mapped.host_us = first_arrival_ + std::llround(mark.x + line(mark.x));
    }
  }

  // Limit the time: not after the arrival, and later than that of the previous frame.
  mapped.host_us = std::max(std::min(mapped.host_us, arrival_us), last_host_ + 1);
  last_device_ = device_us;
  last_arrival_ = arrival_us;
  last_host_ = mapped.host_us;
  return mapped;
}

void DeviceClock::begin(std::int64_t device_us, std::int64_t arrival_us) {
  const std::int64_t last_host = begun_ ? last_host_ : arrival_us - 1;
  *this = {};
  begun_ = true;
  first_device_ = device_us;
  first_arrival_ = arrival_us;
  last_host_ = last_host;
  marks_ = {{0, 0}};
  window_end_ = kWindow;
}

bool DeviceClock::jumped(const Mark& mark) {
  const double delay = mark.y - line(mark.x);
  if (delay < (mark.x < kLearning ? -10 * kEarly : -kEarly)) return true;
  if (delay < kLate) {
    late_since_ = -1;
  } else if (late_since_ < 0) {
    late_since_ = mark.x;
  }
  return late_since_ >= 0 && mark.x - late_since_ > kLatePatience;
}

void DeviceClock::take_in(const Mark& mark) {
  if (mark.x >= window_end_) {
    window_end_ = mark.x + kWindow;
    if (marks_.size() == kMostMarks) marks_.erase(marks_.begin());
    fit();  // fit before the new window begins, because its first arrival may be late
    marks_.push_back(mark);
  } else if (mark.y - slope_ * mark.x < marks_.back().y - slope_ * marks_.back().x) {
    marks_.back() = mark;
    if (marks_.size() < kMarksForDrift) fit();
  }
}

void DeviceClock::fit() {
  // With few marks, fit only the offset.
  if (marks_.size() < kMarksForDrift) {
    slope_ = 0;
    intercept_ = std::ranges::min(marks_, {}, &Mark::y).y;
    return;
  }

  // Otherwise fit offset and slope by linear regression.
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (const Mark& m : marks_) {
    mean_x += m.x / static_cast<double>(marks_.size());
    mean_y += m.y / static_cast<double>(marks_.size());
  }

  // The slope is limited to a drift that is plausible.
  for (const Mark& m : marks_) {
    xx += (m.x - mean_x) * (m.x - mean_x);
    xy += (m.x - mean_x) * (m.y - mean_y);
  }
  slope_ = std::clamp(xy / xx, -kMaxDrift, kMaxDrift);
  intercept_ = mean_y - slope_ * mean_x;
}

}  // namespace barehand
