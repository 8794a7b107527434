#include "drivers/synthetic/rendering/rasteriser.h"

#include <bit>
#include <cassert>

#include "drivers/synthetic/rendering/scan_convert.h"

namespace barehand::synthetic {

// Draws triangles into a z-buffer, and counts the pixels that classes of triangles cover.

namespace {

std::array<Eigen::Vector3d, 3> corners_of(std::span<const Eigen::Vector3f> vertices, const Triangle& t) {
  return {vertices[t[0]].cast<double>(), vertices[t[1]].cast<double>(), vertices[t[2]].cast<double>()};
}

}  // namespace

Rasteriser::Rasteriser(const Intrinsics& camera) : camera_(camera) { clear(); }

void Rasteriser::clear() {
  buffer_.inverse_z.reset(camera_.width, camera_.height, 0.0f);
  buffer_.triangle.reset(camera_.width, camera_.height, kNoTriangle);
}

void Rasteriser::draw(std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles,
                      std::uint32_t first) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t index = first + static_cast<std::uint32_t>(i);
    // Fills one row of pixels.
    const auto fill = [&](int v, int begin, int end, double inverse_z, double step) {
      float* nearest = buffer_.inverse_z.row(v);
      std::uint32_t* front = buffer_.triangle.row(v);
      const float start = static_cast<float>(inverse_z), delta = static_cast<float>(step);

      // Keep the nearer surface in each pixel.
      for (int u = begin; u < end; ++u) {
        const float value = start + static_cast<float>(u - begin) * delta;
        const bool nearer = value > nearest[u];
        nearest[u] = nearer ? value : nearest[u];
        front[u] = nearer ? index : front[u];
      }
    };

    // Clip the triangle, and fill what remains.
    project_clipped(camera_, corners_of(vertices, triangles[i]),
                    [&](const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
                      scan_triangle(camera_.width, camera_.height, a, b, c, fill);
                    });
  }
}

std::vector<int> covered_pixels(const Intrinsics& camera, int margin, std::span<const Eigen::Vector3f> vertices,
                                std::span<const Triangle> triangles, std::span<const std::uint8_t> classes) {
  // Enlarge the image.
  Intrinsics wide = camera;
  wide.width += 2 * margin;
  wide.height += 2 * margin;
  wide.cx += margin;
  wide.cy += margin;

  // Mark the classes that cover each pixel, one bit per class.
  Image<std::uint16_t> covered(wide.width, wide.height, 0);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    assert(classes[i] < 16);
    // Only triangles that face the camera count.
    const auto corners = corners_of(vertices, triangles[i]);
    if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[0]) >= 0) continue;

    // Mark the pixels of the triangle.
    const auto bit = static_cast<std::uint16_t>(1u << classes[i]);
    const auto mark = [&](int v, int begin, int end, double, double) {
      std::uint16_t* row = covered.row(v);
      for (int u = begin; u < end; ++u) row[u] |= bit;
    };
    project_clipped(wide, corners, [&](const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
      scan_triangle(wide.width, wide.height, a, b, c, mark);
    });
  }

  // Count the bits.
  std::vector<int> counts(16, 0);
  for (std::size_t i = 0; i < covered.size(); ++i)
    for (std::uint32_t bits = covered[i]; bits; bits &= bits - 1) ++counts[std::countr_zero(bits)];
  return counts;
}

}  // namespace barehand::synthetic
