#pragma once

#include <Eigen/Core>
#include <optional>

#include "hand/hand_pose.h"
#include "observe/skin_model.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// A place where a hand is expected.
struct ExpectedHand {
  Eigen::Vector3d centre;                 ///< centre of the palm, camera frame [m]
  std::optional<Handedness> side;         ///< none: the hand may be of either side
  std::optional<Handedness> wanted = {};  ///< where either may be: the one that is looked for
  const SkinModel* skin = nullptr;        ///< if given, only what has the colour of skin is looked at
};

/// Where a hand is in a frame, predicted from an earlier estimate by the palm's constant velocity. None: it is not
/// tracked, or not in front of the camera.
std::optional<ExpectedHand> expected_hand(const HandEstimate* earlier, const RgbdFrame& frame);

}  // namespace barehand
