#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "stages/prediction/motion_prediction.h"
#include "stages/refinement/refinement.h"

namespace barehand {

/// The proposer that a hypothesis comes from.
enum class Origin {
  followed,   ///< refined from the prediction
  sampled,    ///< the paper's local trackers and belief propagation
  uncrossed,  ///< the followed pose with crossed fingers put side by side
  detected,   ///< inverse kinematics of the detected joints
  searched,   ///< a search of the whole observation
  near,       ///< a search of the fingers, near the followed pose
};
std::string_view to_string(Origin origin);

/// A pose that may explain the frame, and how well it does. The tracker chooses between hypotheses.
struct Hypothesis {
  Origin origin = Origin::followed;
  RefinedPose refined;                   ///< T_camera_segment, its global score [m] and what it shows of each segment
  double joint_gap = 0;                  ///< HandEstimate::joint_gap [m]
  double size = 1;                       ///< of the hand in view by its profile's, where a search showed another one
  std::optional<Prediction> prediction;  ///< that it continues; none: it was found anew
  std::optional<std::array<Matrix6d, kSegmentCount>> belief;  ///< the sampler's covariance, if it was not refined

  double score() const { return refined.score; }
};

/// Mean gap between the ends of adjacent segments [m] (paper Sec. 5.2).
double joint_gap(const HandProfile& profile, const HandPose& pose);

}  // namespace barehand
