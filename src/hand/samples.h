#pragma once

#include <array>
#include <vector>

#include "hand/hand_pose.h"

namespace barehand {

// Data of the sampling stages: where samples are drawn, the samples, and their beliefs.

/// A uniform distribution in a box around a pose. The box lies along the segment's own axes: offsets (x, y, z) [m] and
/// rotations (about x: flexion, y: abduction, z: twist) [rad] within +-half_width.
struct Kernel {
  SE3 T_camera_segment;
  Vector6d half_width = Vector6d::Zero();
};
/// The distributions from which each local tracker draws its samples: one around the predicted pose at level 0, then
/// one around each of the best samples of the previous level (paper, Sec. 4.4).
using Proposals = std::array<std::vector<Kernel>, kSegmentCount>;

/// Samples of the pose of every segment at one level and their log-likelihoods (paper, Eq. 3): a discretised local pdf.
struct SegmentSamples {
  std::array<std::vector<SE3>, kSegmentCount> poses;
  std::array<std::vector<double>, kSegmentCount> log_likelihood;  ///< all zeros for a segment without observation
  std::array<double, kSegmentCount> unoccluded{};  ///< alpha of the paper's Eq. 3, computed at the prediction
};

/// Marginal posterior of every segment over its samples (paper, Eq. 8).
struct HandBelief {
  std::array<std::vector<double>, kSegmentCount> log_belief;  ///< normalised: the exponentials sum to 1
};

}  // namespace barehand
