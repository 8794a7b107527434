#pragma once

#include "barehand/grasp_state_t.hpp"
#include "hand/grasps/frame_grasps.h"
#include "hand/hand_pose.h"

namespace barehand {

/// The message about how one hand grasps.
grasp_state_t grasp_message(const HandEstimate& estimate, const HandGrasp& grasp);

}  // namespace barehand
