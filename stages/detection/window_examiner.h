#pragma once

#include <optional>

#include "observe/detection.h"
#include "sensor/rgbd_frame.h"
#include "stages/detection/expected_hand.h"
#include "stages/detection/network.h"

namespace barehand {

/// Estimates joints, side and labels of the hand at a place of the depth image, by the second network on up to three
/// windows. Not thread-safe, but several examiners may work at the same time.
class WindowExaminer {
 public:
  explicit WindowExaminer(Network crop) : crop_(std::move(crop)) {}

  /// Empty if there is no hand. Error: the network returns values that are not finite.
  Result<std::optional<DetectedHand>> examine(const RgbdFrame& frame, const ExpectedHand& place, Workers& workers);

 private:
  /// The result of the network for one window.
  struct Window {
    DetectedHand hand;
    double hand_area = 0;  // area of the pixels labelled as hand, projected onto a plane facing the camera [m^2]
  };
  Result<Window> run_network(const RgbdFrame& frame, const Eigen::Vector3d& centre, Handedness side,
                             const SkinModel* skin, Workers& workers);

  Network crop_;
  Image<float> depth_;  // scratch: the depth image, resampled for the current window
  NetworkInput input_;  // scratch: input of the network for this window
};

}  // namespace barehand
