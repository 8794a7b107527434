// Smooth curves through keyframes, and the tremor of a hand.
#include "drivers/synthetic/sequences/keyframes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "drivers/synthetic/random_keys.h"
#include "math/random.h"

namespace barehand::synthetic {
namespace {

/// Slope of the curve at a key: the weighted harmonic mean of the slopes `before` and `after` of the two secants at the
/// key, or 0 at an extremum. `h_before`, `h_after`: the times between the keys [s].
double slope(double before, double after, double h_before, double h_after) {
  if (before * after <= 0) return 0;
  const double w1 = 2 * h_after + h_before, w2 = h_after + 2 * h_before;
  return (w1 + w2) / (w1 / before + w2 / after);
}

/// All values of a key in one list.
std::vector<double> flat(const HandKey& key) {
  std::vector<double> values = {key.position.x(), key.position.y(), key.position.z(),
                                key.turn.x(),     key.turn.y(),     key.turn.z()};
  for (const FingerAngles& finger : key.angles) {
    values.push_back(finger.abduction);
    values.insert(values.end(), finger.flexion.begin(), finger.flexion.end());
  }
  return values;
}

SmoothTrack make_track(const std::vector<HandKey>& keys) {
  std::vector<double> times;
  std::vector<std::vector<double>> values;
  for (const HandKey& key : keys) {
    times.push_back(key.time);
    values.push_back(flat(key));
  }
  return {std::move(times), std::move(values)};
}

/// Smooth noise in [-1, 1]: the mean of three sines of random phase and frequency.
double drift(double time, std::uint64_t seed, std::uint32_t channel) {
  KeyedRandom random(seed, channel, 0, static_cast<std::uint32_t>(Draw::tremor));
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double frequency = random.uniform(0.2, 1.1), phase = random.uniform(0, 2 * std::numbers::pi);
    sum += std::sin(2 * std::numbers::pi * frequency * time + phase);
  }
  return sum / 3;
}

}  // namespace

SmoothTrack::SmoothTrack(std::vector<double> times, std::vector<std::vector<double>> values)
    : times_(std::move(times)), values_(std::move(values)) {
  assert(!times_.empty() && times_.size() == values_.size());
  slopes_.assign(values_.size(), std::vector<double>(values_.front().size(), 0.0));
  for (std::size_t k = 1; k + 1 < times_.size(); ++k) {
    const double before = times_[k] - times_[k - 1], after = times_[k + 1] - times_[k];
    assert(before > 0 && after > 0);
    for (std::size_t i = 0; i < values_[k].size(); ++i)
      slopes_[k][i] = slope((values_[k][i] - values_[k - 1][i]) / before, (values_[k + 1][i] - values_[k][i]) / after,
                            before, after);
  }
}

std::vector<double> SmoothTrack::at(double time) const {
  if (time <= times_.front()) return values_.front();
  if (time >= times_.back()) return values_.back();

  // Cubic Hermite interpolation between the keys k and k + 1.
  const auto k = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), time) - times_.begin()) - 1;
  const double h = times_[k + 1] - times_[k], s = (time - times_[k]) / h;
  const double h00 = (1 + 2 * s) * (1 - s) * (1 - s), h10 = s * (1 - s) * (1 - s), h01 = s * s * (3 - 2 * s),
               h11 = s * s * (s - 1);
  std::vector<double> result(values_[k].size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = h00 * values_[k][i] + h10 * h * slopes_[k][i] + h01 * values_[k + 1][i] + h11 * h * slopes_[k + 1][i];
  return result;
}

HandTrack::HandTrack(const Eigen::Matrix3d& base, const std::vector<HandKey>& keys)
    : base_(base), track_(make_track(keys)) {}

SkeletonPose HandTrack::at(double time) const {
  const std::vector<double> v = track_.at(time);
  SkeletonPose pose;
  pose.T_camera_palm = {exp_so3({v[3], v[4], v[5]}) * base_, {v[0], v[1], v[2]}};
  for (int finger = 0; finger < kFingerCount; ++finger) {
    const double* angles = v.data() + 6 + 4 * finger;
    pose.angles[finger] = {angles[0], {angles[1], angles[2], angles[3]}};
  }
  return pose;
}

SkeletonPose with_tremor(const SkeletonPose& pose, double time, std::uint64_t seed) {
  std::uint32_t channel = 0;
  const auto next = [&](double amplitude) { return amplitude * drift(time, seed, channel++); };
  SkeletonPose moved = pose;
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = next(i < 3 ? 0.0015 : 0.02);
  moved.T_camera_palm = boxplus(pose.T_camera_palm, twist);
  for (FingerAngles& finger : moved.angles) {
    finger.abduction += next(0.012);
    for (double& angle : finger.flexion) angle += next(0.025);
  }
  return moved;
}

}  // namespace barehand::synthetic
