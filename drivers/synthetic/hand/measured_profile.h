#pragma once

#include "drivers/synthetic/hand/hand_mesh.h"
#include "hand/profile.h"

namespace barehand::synthetic {

/// The hand profile that a careful person would measure on this mesh at rest. Joint frames are those of the rig, and
/// bone lengths are distances between joints. Around every bone a tapered skin is fitted to the surface that follows
/// it, once round about the bone and once elliptic about a centre line of its own. The distal end of a fingertip is
/// the centre of its cap, so that the skin ends one distal radius beyond it. The joints' axes and ranges are those of
/// joint_dofs().
HandProfile measure_profile(const HandMesh& mesh);

}  // namespace barehand::synthetic
