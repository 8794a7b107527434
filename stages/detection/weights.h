#pragma once

#include <string>

#include "core/error.h"

namespace barehand {

/// The two networks' files, as a folder of weights holds them.
struct DetectionWeights {
  std::string version;
  std::string full, crop;            ///< bytes of the ONNX files
  std::string full_path, crop_path;  ///< for messages
};

/// Reads `folder`/nets.json and the files it names. Errors: a file that is missing or is not the one of nets.json
/// (size, CRC-32), an interface that this program does not know.
Result<DetectionWeights> load_weights(const std::string& folder);

}  // namespace barehand
