#pragma once

#include "drivers/synthetic/grasps/grasp_recipe.h"
#include "drivers/synthetic/hand/skinning.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

/// A hand that holds an object between opposing places of its skin.
struct OpposedGrasp {
  HandAngles angles;
  SE3 T_palm_hold;
};

/// Finds joint angles with which the touches of a recipe lie on a hold and face it. The hold counts as an endless rod,
/// an endless slab or a ball; it lies in the middle between the touches, with y from the first to the second ones.
class Opposition {
 public:
  Opposition(const HandRig& rig, const GraspRecipe& recipe, const Hold& hold);

  /// The best hand near `comfortable`, within the joints' ranges, by a pattern search.
  OpposedGrasp solve(const HandAngles& comfortable) const;

 private:
  // A touch as a place and an outward direction in its segment's frame.
  struct SkinPlace {
    int segment = 0;
    Eigen::Vector3d place, normal;
  };
  SkinPlace on_skin(const HandMesh& mesh, const Touch& touch) const;
  SE3 hold_of(const HandPose& pose) const;
  double cost(const HandAngles& angles, const HandAngles& comfortable) const;

  const HandProfile& profile_;
  Eigen::Vector3d along_;
  HoldKind kind_;
  double radius_;
  double least_abduction_, most_abduction_;  // range of the thumb's abduction [rad]
  std::vector<SkinPlace> touches_;           // the first ones, then the second ones
  std::size_t first_count_;
  std::optional<SkinPlace> rest_;
  std::array<bool, kFingerCount> moves_{};
};

}  // namespace barehand::synthetic
