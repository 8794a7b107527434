#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace barehand {

/// Maps a sensor's time stamps onto the host's steady clock. A frame arrives after its exposure by a least delay and
/// more: per window of time the earliest arrival (arrival - stamp) marks the delay, and a straight line through the
/// last windows' marks is offset and drift. Delays beyond the least are thus seen as what they are, late arrivals, and
/// do not shift the time of the exposure; the least delay itself cannot be observed and stays in. Microseconds.
class DeviceClock {
 public:
  struct Mapped {
    std::int64_t host_us = 0;                    ///< later than that of the frame before, never after the arrival
    std::optional<std::int64_t> jumped_by = {};  ///< the sensor's clock was set forward (or back) by this
  };

  /// Frames in the order in which they arrive.
  Mapped map(std::int64_t device_us, std::int64_t arrival_us);

  /// How much faster than the host's the sensor's clock runs, parts per million; 0 until it can be told.
  double drift_ppm() const { return -1e6 * slope_; }

 private:
  /// Earliest arrival of a window: x since the first stamp, y = arrival - stamp, both since the first frame.
  struct Mark {
    double x = 0, y = 0;
  };
  void begin(std::int64_t device_us, std::int64_t arrival_us);
  void take_in(const Mark& mark);
  void fit();
  double line(double x) const { return intercept_ + slope_ * x; }
  bool jumped(const Mark& mark);

  bool begun_ = false;
  std::int64_t first_device_ = 0, first_arrival_ = 0;
  std::int64_t last_device_ = 0, last_arrival_ = 0, last_host_ = 0;
  std::vector<Mark> marks_;  ///< of the last windows; the newest is still open
  double window_end_ = 0;
  double intercept_ = 0, slope_ = 0;  ///< of y over x
  double late_since_ = -1;            ///< x since which every frame was late; < 0: none is
};

}  // namespace barehand
