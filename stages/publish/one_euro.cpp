// The One-Euro filter for positions and orientations.
#include "stages/publish/one_euro.h"

#include <cassert>
#include <numbers>

namespace barehand {
namespace {

/// Weight of the new value in a first-order low pass. `cutoff` [Hz], `dt` [s].
double weight(double cutoff, double dt) {
  const double tau = 1 / (2 * std::numbers::pi * cutoff);
  return 1 / (1 + tau / dt);
}

}  // namespace

SE3 OneEuroPose::filter(const SE3& raw, double dt, const OneEuroParams& params) {
  assert(!started_ || dt > 0);
  if (!started_) {
    started_ = true;
    speed_.setZero();
    smoothed_ = raw;
  } else {
    // Smooth the speed first, then the pose with a cutoff frequency that increases with the speed.
    speed_ += weight(params.speed_cutoff, dt) * (boxminus(raw, raw_) / dt - speed_);
    Vector6d step = boxminus(raw, smoothed_);
    step.head<3>() *= weight(params.min_cutoff + params.beta * speed_.head<3>().norm(), dt);
    step.tail<3>() *= weight(params.min_cutoff + params.beta_rotation * speed_.tail<3>().norm(), dt);

    smoothed_ = boxplus(smoothed_, step);
    smoothed_.R = orthonormalised(smoothed_.R);
  }
  raw_ = raw;
  return smoothed_;
}

}  // namespace barehand
