#pragma once

#include "drivers/synthetic/hand_mesh.h"
#include "hand/profile.h"

namespace barehand::synthetic {

/// The hand profile that a careful person would measure on this mesh at rest: joint frames as rigged, bone lengths
/// between joints, and a tapered skin around every bone fitted to the surface that follows it: round about the bone,
/// and elliptic about its own centre line. The distal end of a fingertip is where the cap's centre lies, so that the
/// skin ends one distal radius beyond it. Ranges of motion as in docs/formats.md; thumb, index, middle: abduction
/// counts away from the middle finger, the middle finger's towards the index.
HandProfile measure_profile(const HandMesh& mesh);

}  // namespace barehand::synthetic
