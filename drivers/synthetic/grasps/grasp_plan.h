#pragma once

#include "drivers/synthetic/grasps/daily_objects.h"
#include "drivers/synthetic/hand/skeleton.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

/// How a right hand holds an object.
struct PlannedGrasp {
  DailyObject object;
  SE3 T_palm_object;
  HandAngles open, held;                                  ///< angles before the object is held, and while it is held
  Eigen::Vector3d withdrawal = Eigen::Vector3d::UnitZ();  ///< direction in which the open hand leaves (palm frame)
};

/// The objects that can be held with this class of grasp, of those for testing or the others.
std::vector<std::string> objects_for(int type, bool for_testing);

/// Whether this object can be held with this class of grasp.
bool can_hold(int type, const std::string& object);

/// Plans a grasp of this class (index in grasp_types()). The seed varies the size of the object, the way it is turned,
/// and the angles. Error: the object has no part that this grasp fits; the message names objects that have.
Result<PlannedGrasp> plan_grasp(const HandRig& rig, int type, const std::string& object, std::uint64_t seed);

}  // namespace barehand::synthetic
