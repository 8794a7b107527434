#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/image.h"
#include "drivers/synthetic/hand_mesh.h"
#include "math/camera.h"

namespace barehand::synthetic {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// Which triangle is in front at every pixel, and how far. 1/z is linear in the image: exact for perspective.
struct VisibilityBuffer {
  Image<float> inverse_z;         ///< 1 / z of the front-most surface [1/m]; 0 = nothing there
  Image<std::uint32_t> triangle;  ///< its index; kNoTriangle = nothing there
};

/// Rasterises triangles in the camera frame, from both sides, with a z-buffer. A pixel belongs to a triangle if its
/// centre lies inside; triangles that share an edge leave neither gap nor overlap. What is nearer than `kNearPlane`
/// is clipped away.
class Rasteriser {
 public:
  static constexpr double kNearPlane = 0.02;  ///< [m]

  explicit Rasteriser(const Intrinsics& camera);
  void clear();
  /// Triangles get the indices first, first + 1, ... in the buffer.
  void draw(std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles, std::uint32_t first);
  const VisibilityBuffer& buffer() const { return buffer_; }
  const Intrinsics& camera() const { return camera_; }

 private:
  Intrinsics camera_;
  VisibilityBuffer buffer_;
};

/// Counts for every class of triangles (at most 16) the pixels that its outer side, counter-clockwise triangles, covers
/// when nothing else is drawn. The image is widened on all sides by `margin` pixels, so that what lies just outside the
/// view counts as well.
std::vector<int> covered_pixels(const Intrinsics& camera, int margin, std::span<const Eigen::Vector3f> vertices,
                                std::span<const Triangle> triangles, std::span<const std::uint8_t> classes);

}  // namespace barehand::synthetic
