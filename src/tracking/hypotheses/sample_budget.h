#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/clock.h"
#include "stages/segment_tracker/segment_tracker_params.h"

namespace barehand {

/// Determines how many samples are drawn per segment on each level of the coarse-to-fine search. On the CPU this is S
/// (SegmentTrackerParams::samples). If a GPU compares the samples with the data, it is the largest number with which a
/// whole level stays within a time budget. The GPU makes only the comparison cheap: belief propagation stays on the
/// CPU, and its cost grows with the square of the number of samples.
class SampleBudget {
 public:
  /// Runs one search level: draws, compares and fuses `samples` samples of every segment.
  using Level = std::function<void(int samples)>;

  explicit SampleBudget(const SegmentTrackerParams& params,
                        std::shared_ptr<const Clock> clock = std::make_shared<SystemClock>())
      : params_(params), clock_(std::move(clock)) {}

  /// Whether measure() should be called: once, as soon as a graphics device compares the samples.
  bool to_be_measured(bool on_device) const {
    return on_device && on_device_ == 0 && params_.samples_on_device > params_.samples;
  }
  /// Runs `level` with more and more samples until it takes longer than the budget or the maximum number is reached.
  void measure(const Level& level);
  /// The result of measure(), for the log.
  std::string to_text() const;

  int samples(bool on_device) const { return on_device && on_device_ > 0 ? on_device_ : params_.samples; }

 private:
  double seconds(const Level& level, int samples) const;

  SegmentTrackerParams params_;
  std::shared_ptr<const Clock> clock_;
  int on_device_ = 0;  // number of samples per segment if a GPU compares them; 0: not measured yet
  // Time of a level with `on_device_` samples [s]; 0: even the first number above that of the CPU exceeds the budget.
  double level_seconds_ = 0;
};

}  // namespace barehand
