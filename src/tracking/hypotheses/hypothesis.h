#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "stages/prediction/motion_prediction.h"
#include "stages/refinement/refinement.h"

namespace barehand {

// Hypotheses: poses that may explain a frame.

/// How a hypothesis was found.
enum class Origin {
  followed,   ///< by refining the prediction
  sampled,    ///< by the paper's local trackers and belief propagation
  uncrossed,  ///< by putting crossed fingers of the followed pose side by side
  detected,   ///< by inverse kinematics of the detected joints
  searched,   ///< by a search of the whole observation
  near,       ///< by a search of finger poses near the followed pose
};
std::string_view to_string(Origin origin);

/// A pose that may explain the frame, and how well it does. The tracker chooses between hypotheses.
struct Hypothesis {
  Origin origin = Origin::followed;
  RefinedPose refined;                   ///< pose, global score [m], visible and matched fraction of each segment
  double joint_gap = 0;                  ///< HandEstimate::joint_gap [m]
  double size = 1;                       ///< size of the hand in view, as a factor on the profile's size
  std::optional<Prediction> prediction;  ///< the prediction that the pose continues; none: found without one
  std::optional<std::array<Matrix6d, kSegmentCount>> belief;  ///< covariance from the sampler, if not refined

  double score() const { return refined.score; }
};

/// Mean gap between the ends of adjacent segments [m] (paper Sec. 5.2).
double joint_gap(const HandProfile& profile, const HandPose& pose);

}  // namespace barehand
