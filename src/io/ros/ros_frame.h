#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "io/ros/ros_types.h"
#include "sensor/rgbd_frame.h"

namespace barehand::ros {

/// Name of the camera's coordinate frame (x right, y down, z forward): the sensor's name, or "camera" if that is empty,
/// followed by "_optical_frame".
std::string camera_frame(const std::string& sensor);

// Messages of one frame of a depth camera. Every header has the frame's time stamp, which time_of() must accept, and
// camera_frame().

/// The camera as a pinhole camera without distortion.
CameraInfo camera_info(const RgbdFrame& frame);
/// The depth image in the sensor's units, encoding 16UC1. ROS assumes that a unit is a millimetre; if it is not, the
/// unit must be passed separately (kDepthUnit).
Image depth_image(const RgbdFrame& frame);
/// The colour image, which the frame must have, as PNG or as JPEG of the given quality.
Result<CompressedImage> colour_image(const RgbdFrame& frame, std::optional<int> jpeg_quality);
/// Points x, y, z [m], with rgb if the frame has colour, of the pixels with depth on a grid of about `most` pixels.
PointCloud2 point_cloud(const RgbdFrame& frame, int most = 20'000);

/// The values of a depth image in 16UC1 or mono16. Errors: another encoding, an impossible size, too few bytes.
Result<barehand::Image<std::uint16_t>> depth_of(const Image& image);
/// The pixels of a colour image in rgb8 or bgr8. Errors as for depth_of().
Result<barehand::Image<Rgb>> colour_of(const Image& image);
/// The intrinsics of a camera info, whose distortion is ignored. Error: the numbers are not plausible.
Result<Intrinsics> camera_of(const CameraInfo& info);

}  // namespace barehand::ros
