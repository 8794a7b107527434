#pragma once

#include <vector>

#include "math/camera.h"
#include "observe/detection.h"

namespace barehand {

/// Whether some joints are within 2 cm of the image's border or beyond it, so that the image may show only a part of
/// the hand.
bool cut_by_border(const DetectedJoints& joints, const Intrinsics& camera);

/// Other joints that would look similar in an image that shows only a part of the hand. The detection networks place
/// all fingers inside the image, so that they may take a finger for one of its neighbours: a ring finger that seems to
/// be the index finger, because the true one is outside. Most elements move all fingers but the thumb by one or two
/// places; fingers that nothing was taken for lie beside the others and are uncertain. One has the thumb spread, since
/// a thumb that is outside may be reported before the palm.
std::vector<DetectedJoints> with_fingers_moved(const DetectedJoints& joints);

}  // namespace barehand
