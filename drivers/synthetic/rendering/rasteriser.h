#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/image.h"
#include "drivers/synthetic/hand/hand_mesh.h"
#include "math/camera.h"

namespace barehand::synthetic {

// Draws triangles into a z-buffer.

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// The front-most triangle at every pixel, and its distance as 1 / z. On a plane, 1 / z is linear in the image under
/// perspective projection, so that its interpolation is exact.
struct VisibilityBuffer {
  Image<float> inverse_z;         ///< 1 / z of the front-most triangle [1/m]; 0: there is none
  Image<std::uint32_t> triangle;  ///< index of the front-most triangle; kNoTriangle: there is none
};

/// Rasterises triangles in the camera frame with a z-buffer; both of their sides are visible. A pixel belongs to a
/// triangle if its centre lies inside; triangles that share an edge leave neither a gap nor an overlap. Parts nearer
/// than kNearPlane are clipped.
class Rasteriser {
 public:
  static constexpr double kNearPlane = 0.02;  ///< distance of the near plane [m]

  explicit Rasteriser(const Intrinsics& camera);
  /// Empties the buffer.
  void clear();
  /// Draws triangles. Their indices in the buffer are first, first + 1, ...
  void draw(std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles, std::uint32_t first);
  const VisibilityBuffer& buffer() const { return buffer_; }
  const Intrinsics& camera() const { return camera_; }

 private:
  Intrinsics camera_;
  VisibilityBuffer buffer_;
};

/// Counts for every class of triangles (at most 16) the pixels that its outer sides cover when nothing else is drawn.
/// Seen from outside, triangles are counter-clockwise. The image is enlarged by `margin` pixels on all sides, so that
/// parts just outside the view count as well.
std::vector<int> covered_pixels(const Intrinsics& camera, int margin, std::span<const Eigen::Vector3f> vertices,
                                std::span<const Triangle> triangles, std::span<const std::uint8_t> classes);

}  // namespace barehand::synthetic
