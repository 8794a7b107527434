#pragma once

#include <array>
#include <memory>
#include <string>

#include "core/error.h"
#include "core/image.h"

namespace barehand {

class Workers;

// A detection network that oneDNN runs.

/// The input of a network: a part of a depth image in two channels of equal size.
struct NetworkInput {
  Image<float> depth;  ///< scaled and clipped as in the training
  Image<float> valid;  ///< 1 = the pixel has a depth, 0 = it has none
};

/// The output of a network. The planes are stored one after the other, row-major; they are valid until the next call.
struct NetworkOutput {
  int maps = 0, map_width = 0, map_height = 0;  ///< number of heat maps, and their size: a quarter of the input's
  const float* map = nullptr;
  int label_width = 0, label_height = 0;  ///< size of the label planes: half of the input's
  const float* label = nullptr;           ///< logits, one plane per SurfaceLabel
  float side = 0;                         ///< log odds of a right hand
  float hand = 0;                         ///< log odds of any hand; 0 if the network does not tell

  const float* map_plane(int i) const { return map + static_cast<std::size_t>(i) * map_width * map_height; }
  const float* label_plane(int i) const { return label + static_cast<std::size_t>(i) * label_width * label_height; }
};

/// The input size and the number of heat maps that a network must have, and whether it must tell hands.
struct NetworkShape {
  int width = 0, height = 0, maps = 0;
  bool tells_hands = false;
};

/// One network with its weights, run by oneDNN. Not thread-safe.
class Network {
 public:
  /// Loads a network from the bytes of an ONNX file; `name` is for error messages. Errors: those of read_onnx(); it
  /// has another shape; it cannot be run; it returns values that are not finite.
  static Result<Network> load(const std::string& bytes, const std::string& name, const NetworkShape& shape);
  Network(Network&&) noexcept;
  Network& operator=(Network&&) noexcept;
  ~Network();

  /// Runs on the calling thread and, for the large convolutions, on one other worker; the result does not depend on
  /// their number. Error: the network returns values that are not finite.
  Result<NetworkOutput> run(const NetworkInput& input, Workers& workers);

 private:
  struct Net;
  Network(std::unique_ptr<Net> net, std::string name, const NetworkShape& shape);

  std::unique_ptr<Net> net_;
  std::string name_;
  NetworkShape shape_;
};

}  // namespace barehand
