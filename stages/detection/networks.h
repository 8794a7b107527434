#pragma once

#include <vector>

#include "observe/detection.h"
#include "stages/detection/depth_view.h"
#include "stages/detection/network.h"

namespace barehand {

// Inputs and outputs of the two detection networks (docs/nets.md): `full` finds palms in the whole frame, `crop` finds
// the joints of a hand in a window. Inputs must be made as in the training.

inline constexpr NetworkShape kFullShape{160, 120, 2}, kCropShape{96, 96, 2 * kLandmarkCount, true};
/// Cell i of a heat map lies at input pixel i * kMapStep + kMapOffset.
inline constexpr double kMapStep = 4, kMapOffset = 1.5;

/// Windows of the depth image for `full` that together cover the frame: one, unless the camera's angle of view is wider
/// than any in the training.
std::vector<DepthView> frame_views(const Intrinsics& camera);
/// The window of the depth image in which the network `crop` looks for a hand's joints, centred on `centre` (camera
/// frame [m], z > 0).
DepthView window_around(const Eigen::Vector3d& centre, const Intrinsics& camera);

/// Makes the input of `full` from the depth image of such a window [m].
void fill_full(const Image<float>& depth, NetworkInput& input);
/// Makes the input of `crop` from the depth image of a window [m]. `middle`: depth of the window's centre [m].
/// `mirrored`: the input is mirrored left to right, which turns a left hand into a right one.
void fill_crop(const Image<float>& depth, double middle, bool mirrored, NetworkInput& input);

/// Reads the labels of either network. `mirrored`: whether the input was mirrored.
void read_labels(const NetworkOutput& output, const DepthView& view, bool mirrored, LabelMap& out);
/// Reads one joint, with its covariance, from the output of `crop`. `middle` and `mirrored` as for fill_crop().
DetectedJoint read_joint(const NetworkOutput& output, int joint, const DepthView& view, double middle, bool mirrored,
                         const Intrinsics& camera);

}  // namespace barehand
