#pragma once

#include "drivers/synthetic/hand/hand_mesh.h"
#include "hand/profile.h"

namespace barehand::synthetic {

/// Measures the hand profile of a mesh at rest. Joint frames are those of the rig, and bone lengths are the distances
/// between joints. To the surface around every bone, two tapered skins are fitted: a round one about the bone, and an
/// elliptic one about a centre line of its own. The distal end of a fingertip is the centre of its cap, so that the
/// skin ends one distal radius beyond it. The joints' axes and ranges are those of joint_dofs().
HandProfile measure_profile(const HandMesh& mesh);

}  // namespace barehand::synthetic
