#pragma once

#include <vector>

#include "observe/detection.h"
#include "stages/detection/depth_view.h"
#include "stages/detection/network.h"

namespace barehand {

/// How the two networks are fed and read, as they were trained (docs/nets.md). Input pixels unless a name says
/// otherwise.
inline constexpr NetworkShape kFullShape{160, 120, 2}, kCropShape{96, 96, 2 * kLandmarkCount};
inline constexpr double kMapStep = 4, kMapOffset = 1.5;  ///< cell i of a heat map is pixel i * step + offset

/// Views for `full` that cover the frame together: one, unless its angle of view is wider than any that was trained
/// with.
std::vector<DepthView> frame_views(const Intrinsics& camera);
/// The view for `crop` around a point of the camera frame with z > 0.
DepthView window_around(const Eigen::Vector3d& centre, const Intrinsics& camera);

void fill_full(const Image<float>& depth, NetworkInput& input);
/// `middle`: depth of the window [m]. `mirrored`: as seen in a mirror, where a left hand is a right one.
void fill_crop(const Image<float>& depth, double middle, bool mirrored, NetworkInput& input);

void read_labels(const NetworkOutput& output, const DepthView& view, bool mirrored, LabelMap& out);
/// One joint of `crop` with its spread.
DetectedJoint read_joint(const NetworkOutput& output, int joint, const DepthView& view, double middle, bool mirrored,
                         const Intrinsics& camera);

}  // namespace barehand
