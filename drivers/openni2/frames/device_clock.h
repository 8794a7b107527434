#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace barehand {

/// Maps a sensor's time stamps to the host's steady clock. A frame arrives after its exposure by a minimum delay plus a
/// random one. In each window of time, the earliest arrival (arrival - time stamp) marks the minimum delay, and a
/// straight line through the marks of the last windows gives offset and drift. Random delays therefore do not shift the
/// estimated time of exposure; the minimum delay itself cannot be observed and remains in the result. All times are in
/// microseconds.
class DeviceClock {
 public:
  struct Mapped {
    std::int64_t host_us = 0;  ///< later than that of the previous frame, and otherwise not after the arrival
    std::optional<std::int64_t> jumped_by = {};  ///< time by which the sensor's clock was set; negative: back
  };

  /// Maps the time stamp of one frame; call it for all frames in the order of their arrival.
  Mapped map(std::int64_t device_us, std::int64_t arrival_us);

  /// How much faster the sensor's clock runs than the host's, in parts per million; 0 until it is known.
  double drift_ppm() const { return -1e6 * slope_; }

 private:
  /// Earliest arrival within a window: x = time stamp, y = arrival - time stamp, both relative to the first frame.
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
  std::vector<Mark> marks_;  ///< marks of the last windows; the newest window is still open
  double window_end_ = 0;
  double intercept_ = 0, slope_ = 0;  ///< offset and slope of the line y(x)
  double late_since_ = -1;            ///< x from which on all frames were late; negative: the last frame was not late
};

}  // namespace barehand
