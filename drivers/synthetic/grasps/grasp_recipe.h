#pragma once

#include <optional>
#include <vector>

#include "drivers/synthetic/grasps/hold.h"
#include "drivers/synthetic/hand/skeleton.h"

namespace barehand::synthetic {

/// A place on the skin that touches the object: on this segment, at this fraction of its bone, on the side that
/// `direction` (segment frame) points to.
struct Touch {
  int segment = 0;
  double along = 0.5;
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitY();
};

/// Holds that a grasp is good for: of this kind, with a width and length in these ranges [m].
struct Fit {
  HoldKind kind = HoldKind::ball;
  double narrowest = 0, widest = 0, longest = 1, shortest = 0;
};

/// How a right hand makes a grasp. Directions and places are in the palm's frame: x away from the thumb, y out of the
/// back of the hand, -z towards the fingers.
struct GraspRecipe {
  std::vector<Fit> fits;
  HandAngles comfortable;  ///< relaxed hand, near which the grasp is searched; for palm opposition: as it approaches
                           ///< the object
  Eigen::Vector3d along = -Eigen::Vector3d::UnitX();  ///< preferred direction of the hold's x axis

  // For palm opposition.
  Eigen::Vector3d at_palm = Eigen::Vector3d::Zero();  ///< position from which the object approaches the palm
  HandAngles closed;                                  ///< the hand closed as far as possible

  // For the other oppositions.
  std::vector<Touch> first, second;                ///< opposing places; both empty: the palm opposes the fingers
  std::optional<Touch> rest;                       ///< where a rod leans against the hand, which replaces `along`
  HandAngles opening;                              ///< added to the angles to open the hand
  double least_abduction = 0, most_abduction = 0;  ///< range of the thumb's abduction [rad]
};

/// The recipe of every class of grasp_types(), in the same order.
const std::vector<GraspRecipe>& grasp_recipes();

}  // namespace barehand::synthetic
