#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "io/ros/ros_types.h"
#include "sensor/rgbd_frame.h"

namespace barehand::ros {

/// The camera's frame, x right, y down, z forward: "camera_optical_frame", or with the sensor's name.
std::string camera_frame(const std::string& sensor);

// One frame of a depth camera. Every header has the frame's stamp and camera_frame. A stamp must be one that time_of
// takes.

/// A pinhole without distortion.
CameraInfo camera_info(const RgbdFrame& frame);
/// Counts as measured, 16UC1. In other units than a millimetre, which ROS takes for granted, the unit must be told
/// beside.
Image depth_image(const RgbdFrame& frame);
/// PNG, or JPEG of this quality. The frame has colour.
Result<CompressedImage> colour_image(const RgbdFrame& frame, std::optional<int> jpeg_quality);
/// x, y, z [m], and rgb where there is colour, of at most `most` pixels with depth on a grid.
PointCloud2 point_cloud(const RgbdFrame& frame, int most = 20'000);

/// Counts of an image in 16UC1 or mono16. Errors: another encoding, an impossible size, too few bytes.
Result<barehand::Image<std::uint16_t>> depth_of(const Image& image);
/// Pixels of an image in rgb8 or bgr8. Errors: as above.
Result<barehand::Image<Rgb>> colour_of(const Image& image);
/// The pinhole that a camera info states. Error: no camera has these numbers.
Result<Intrinsics> camera_of(const CameraInfo& info);

}  // namespace barehand::ros
