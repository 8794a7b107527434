#include "stages/fusion/fusion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "math/angles.h"
#include "math/schedule.h"

namespace barehand {

// Combines the samples of all segments by belief propagation, places the boxes in which the next search level draws,
// and reads the pose from the last level.

namespace {

constexpr std::array<int, kSegmentCount> kParents = [] {
  std::array<int, kSegmentCount> parents{};
  for (int s = 0; s < kSegmentCount; ++s) parents[s] = parent_of(s);
  return parents;
}();

}  // namespace

Fusion::Fusion(const FusionParams& params, std::shared_ptr<const HandProfile> profile, Workers& workers)
    : params_(params), joints_(make_joint_models(*profile, params)), workers_(workers), propagation_(kParents) {}

Vector6d Fusion::half_width(int segment, int level, double interval_factor) const {
  const FusionParams& p = params_;
  Vector6d width;
  width.head<3>().setConstant(p.range_translation);
  width.tail<3>() << p.range_flexion_deg, p.range_abduction_deg, p.range_twist_deg;
  if (segment == kPalm) width.tail<3>().setConstant(p.range_palm_deg);
  width.tail<3>() *= kDegree;
  return width * interval_factor * geometric(1, p.range_end, level, p.levels);
}

const Proposals& Fusion::first_proposals(const HandPose& predicted, double interval_factor) {
  for (int s = 0; s < kSegmentCount; ++s) proposals_[s].assign(1, {predicted[s], half_width(s, 0, interval_factor)});
  return proposals_;
}

const HandBelief& Fusion::fuse(const SegmentSamples& samples, int level) {
  // Compute the energies of all pairs of samples at every joint (paper, Eq. 4).
  const double sigma_prox = geometric(params_.sigma_prox_start, params_.sigma_prox_end, level, params_.levels);
  workers_.for_each_index(kSegmentCount - 1, [&](int i) {
    const int s = i + 1;
    frames_[s].reset(joints_[s], samples.poses[parent_of(s)]);
    joint_energy(joints_[s], sigma_prox, frames_[s], samples.poses[s], energy_[s]);
  });

  // Propagate the beliefs over the tree (paper, Eq. 7, 8).
  const Marginals marginals = params_.marginals == "max" ? Marginals::max : Marginals::sum;
  propagation_.run(samples.log_likelihood, energy_, marginals, workers_, belief_.log_belief);
  return belief_;
}

std::int64_t Fusion::memory(std::int64_t samples) {
  return (kSegmentCount - 1) * samples * samples * static_cast<std::int64_t>(sizeof(float));
}

const Proposals& Fusion::next_proposals(const SegmentSamples& samples, const HandBelief& belief, int level,
                                        double interval_factor) {
  for (int s = 0; s < kSegmentCount; ++s) {
    const Vector6d width = half_width(s, level + 1, interval_factor);
    proposals_[s].clear();
    for (const std::size_t i :
         choice_.best(samples.poses[s], belief.log_belief[s], params_.kernels, width, params_.kernel_separation))
      proposals_[s].push_back({samples.poses[s][i], width});
  }
  return proposals_;
}

FusedPose Fusion::read_out(const SegmentSamples& samples, const HandBelief& belief, double interval_factor) const {
  FusedPose fused;

  // Compute each segment's pose: the mean of the samples around the best one, or the best sample alone.
  for (int s = 0; s < kSegmentCount; ++s) {
    const auto& poses = samples.poses[s];
    const auto& log_belief = belief.log_belief[s];
    // With a radius of 0 only the best sample is averaged, so the result is the best sample itself.
    const bool mean = params_.read_out == "mean";
    fused.pose[s] = mode_mean(poses, log_belief, mean ? params_.mode_radius : 0, params_.mode_angle_deg * kDegree);

    // Compute the covariance from the samples and their spacing: n samples fill a box in six dimensions with a spacing
    // of n^(-1/6) of its width.
    const double per_kernel = std::max(1.0, static_cast<double>(poses.size()) / params_.kernels);
    const Vector6d spacing = half_width(s, params_.levels - 1, interval_factor) * std::pow(per_kernel, -1.0 / 6);
    Matrix6d axes = Matrix6d::Zero();
    axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() = fused.pose[s].R;
    const Matrix6d resolution = axes * (spacing.cwiseAbs2() / 3).asDiagonal() * axes.transpose();
    fused.covariance[s] = belief_covariance(poses, log_belief, fused.pose[s]) + resolution;
  }
  return fused;
}

}  // namespace barehand
