#pragma once

#include <array>
#include <vector>

#include "hand/hand_pose.h"

namespace barehand {

/// Uniform box around a pose, in the segment's own axes: offsets (x, y, z) [m] and rotations
/// (about x: flexion, about y: abduction, about z: twist) [rad] within +-half_width.
struct Kernel {
  SE3 T_camera_segment;
  Vector6d half_width = Vector6d::Zero();
};
/// Where each local tracker draws its samples: the predicted pose at level 0, the S' best samples afterwards
/// (Sec. 4.4).
using Proposals = std::array<std::vector<Kernel>, kSegmentCount>;

/// Discretised local pdf of every segment at one level: samples and their log-likelihoods (Eq. 3).
struct SegmentSamples {
  std::array<std::vector<SE3>, kSegmentCount> poses;
  std::array<std::vector<double>, kSegmentCount> log_likelihood;  ///< 0 for a segment that is not observed
  std::array<double, kSegmentCount> unoccluded{};                 ///< alpha of Eq. 3 at the prediction
};

/// Marginal posterior over the samples of every segment (Eq. 8).
struct HandBelief {
  std::array<std::vector<double>, kSegmentCount> log_belief;  ///< normalised: exp sums to 1
};

}  // namespace barehand
