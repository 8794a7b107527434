#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "io/hand/json_fields.h"
#include "sensor/undistortion.h"

namespace barehand {

/// The lens distortion that a camera.json gives (docs/formats.md, "Lens distortion").
struct LensDistortion {
  Distortion coefficients;            ///< all 0 if none are given, or their model is not supported
  std::vector<std::string> warnings;  ///< warnings for the user: coefficients that are given but not used
};

/// Finds the coefficients of distortion in the object of a camera.json, under the names that ROS, OpenCV, Kalibr, the
/// Azure Kinect and librealsense give them. `path`: the file, for messages. Error: a coefficient is not a number.
Result<LensDistortion> read_distortion(const json_fields::Json& json, const std::string& path);

}  // namespace barehand
