#pragma once

#include <string>

#include "core/error.h"

namespace barehand {

/// What to do about files of networks that cannot be used.
inline constexpr const char* kNetworkRemedy = "use the networks that came with this version of Barehand";

/// The contents of a folder with the weights of the two networks.
struct DetectionWeights {
  /// An ONNX file.
  struct File {
    std::string path, bytes;
  };
  std::string version;
  File full, crop;
};

/// Reads `folder`/nets.json and the files that it names. Errors: a file is missing or does not have the CRC-32 that
/// nets.json states; the networks have an interface that this program does not support.
Result<DetectionWeights> load_weights(const std::string& folder);

}  // namespace barehand
