#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "math/camera.h"
#include "sensor/undistortion.h"

namespace barehand {

/// The content of a camera.json (docs/formats.md).
struct CameraFile {
  Intrinsics camera;
  double depth_unit = 0.001;          ///< metres per unit of the depth images
  double fps = 0;                     ///< nominal frames per second; 0 = not stated
  Distortion distortion;              ///< all 0 if none is given, or its model is not supported
  std::vector<std::string> warnings;  ///< warnings for the user: coefficients that are given but not used
};

/// Reads a camera.json. An error names the file and the key that is missing or has a value that no camera can have.
Result<CameraFile> read_camera_json(const std::string& path);

}  // namespace barehand
