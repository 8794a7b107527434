#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/clock.h"
#include "stages/segment_tracker/segment_tracker_params.h"

namespace barehand {

/// How many samples a level has: S on the CPU; where a device compares them more, as many as keep a whole level within
/// its budget. A device makes only the comparison cheap: the pairs of samples that belief propagation fuses grow with
/// the square of their number, on the CPU.
class SampleBudget {
 public:
  /// Draws, compares and fuses so many samples of every segment.
  using Level = std::function<void(int samples)>;

  explicit SampleBudget(const SegmentTrackerParams& params,
                        std::shared_ptr<const Clock> clock = std::make_shared<SystemClock>())
      : params_(params), clock_(std::move(clock)) {}

  /// Once, as soon as a device compares.
  bool to_be_measured(bool on_device) const {
    return on_device && on_device_ == 0 && params_.samples_on_device > params_.samples;
  }
  /// Runs `level` with more and more samples until it takes longer than the budget, or they are as many as allowed.
  void measure(const Level& level);
  /// What was measured, for the log.
  std::string to_text() const;

  int samples(bool on_device) const { return on_device && on_device_ > 0 ? on_device_ : params_.samples; }

 private:
  double seconds(const Level& level, int samples) const;

  SegmentTrackerParams params_;
  std::shared_ptr<const Clock> clock_;
  int on_device_ = 0;         // 0: not measured
  double level_seconds_ = 0;  // what the largest level that fits took; 0: not even one step more fits
};

}  // namespace barehand
