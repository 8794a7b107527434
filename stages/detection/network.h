#pragma once

#include <array>
#include <memory>
#include <string>

#include "core/error.h"
#include "core/image.h"

namespace barehand {

/// A window of depth as the networks see it, two channels of equal size.
struct NetworkInput {
  Image<float> depth;  ///< scaled and clipped as the network was trained
  Image<float> valid;  ///< 1 = measured, 0 = not
};

/// What a network gives back: `maps` planes at a quarter of the input's size, one plane a label at half of it, and the
/// log odds of a right hand. The planes lie one after the other, row-major; they live until the next call.
struct NetworkOutput {
  int maps = 0, map_width = 0, map_height = 0;
  const float* map = nullptr;
  int label_width = 0, label_height = 0;
  const float* label = nullptr;
  float side = 0;

  const float* map_plane(int i) const { return map + static_cast<std::size_t>(i) * map_width * map_height; }
  const float* label_plane(int i) const { return label + static_cast<std::size_t>(i) * label_width * label_height; }
};

/// What the outputs must look like.
struct NetworkShape {
  int width = 0, height = 0, maps = 0;
};

/// One network with its weights, run by OpenCV on the calling thread (cv::setNumThreads). Not for two threads at once.
class Network {
 public:
  /// From the bytes of an ONNX file; `name` is for messages. Errors: no network, another shape, weights that are not
  /// finite.
  static Result<Network> load(const std::string& bytes, const std::string& name, const NetworkShape& shape);
  Network(Network&&) noexcept;
  Network& operator=(Network&&) noexcept;
  ~Network();

  /// Error: the network gives values that are not finite.
  Result<NetworkOutput> run(const NetworkInput& input);

 private:
  struct Net;
  Network(std::unique_ptr<Net> net, std::string name, const NetworkShape& shape);

  std::unique_ptr<Net> net_;
  std::string name_;
  NetworkShape shape_;
};

}  // namespace barehand
