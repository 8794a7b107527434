#pragma once

#include "barehand/grasp_state_t.hpp"
#include "hand/grasps/frame_grasps.h"
#include "hand/hand_pose.h"

namespace barehand {

/// The message about how one hand grasps. `published`: the status in its hand_state_t.
grasp_state_t grasp_message(const HandEstimate& estimate, TrackStatus published, const HandGrasp& grasp);

}  // namespace barehand
