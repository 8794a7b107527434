// Computes depth, viewing angle and colour of the pixels of a rendered image.
#include "drivers/synthetic/rendering/shading.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/synthetic/random_keys.h"
#include "math/random.h"

namespace barehand::synthetic {
namespace {

const Eigen::Vector3f kLamp(-0.35f, -0.8f, -0.1f);   // position of the lamp in the camera frame [m]
constexpr Rgb kNothing = {22, 22, 26};               // colour of pixels without a surface
constexpr float kAmbient = 0.42f, kDiffuse = 0.62f;  // weights of the ambient and the diffuse light

/// A quantity that varies linearly on a triangle, as a function of the point in the camera frame.
struct Linear {
  Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
  float offset = 0;
  float at(const Eigen::Vector3f& p) const { return gradient.dot(p) + offset; }
};

/// The light on a triangle, and the cosine of the viewing angle.
struct TriangleShade {
  Linear light, cosine;
};

/// Interpolates values that are given at the corners of a triangle.
class TriangleFrame {
 public:
  TriangleFrame(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) : a_(a) {
    const Eigen::Vector3f ab = b - a, ac = c - a, n = ab.cross(ac);
    const float square = std::max(n.squaredNorm(), 1e-30f);
    to_b_ = ac.cross(n) / square;
    to_c_ = n.cross(ab) / square;
    facing_ = n.dot(a) <= 0 ? 1.0f : -1.0f;
  }
  /// 1 if the camera sees the outer side of the triangle, -1 if it sees the inner side.
  float facing() const { return facing_; }
  Linear interpolate(float at_a, float at_b, float at_c) const {
    Linear f;
    f.gradient = (at_b - at_a) * to_b_ + (at_c - at_a) * to_c_;
    f.offset = at_a - f.gradient.dot(a_);
    return f;
  }

 private:
  Eigen::Vector3f a_, to_b_, to_c_;
  float facing_ = 1;
};

/// Computes light and viewing angle at the corners of a triangle, to be interpolated between them.
TriangleShade shade_triangle(const SceneGeometry& scene, const Triangle& t) {
  const TriangleFrame frame(scene.vertices[t[0]], scene.vertices[t[1]], scene.vertices[t[2]]);
  std::array<float, 3> light{}, cosine{};
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3f& p = scene.vertices[t[i]];
    const Eigen::Vector3f n = frame.facing() * scene.normals[t[i]];
    light[i] = kAmbient + kDiffuse * std::max(0.0f, n.dot((kLamp - p).normalized()));
    cosine[i] = -n.dot(p.normalized());
  }
  return {frame.interpolate(light[0], light[1], light[2]), frame.interpolate(cosine[0], cosine[1], cosine[2])};
}

std::uint8_t level(float value) { return static_cast<std::uint8_t>(std::clamp(value, 1.0f, 255.0f)); }

Rgb lit(Rgb colour, float light, float noise) {
  return {level(colour.r * light + noise), level(colour.g * light + noise), level(colour.b * light + noise)};
}

/// Fills one row with the grain of the colour sensor: one random byte per pixel, 16 pixels per random block.
void fill_grain(std::uint64_t seed, std::uint32_t frame, std::uint32_t row, std::vector<std::uint8_t>& grain) {
  for (std::size_t u = 0; u < grain.size(); u += 16) {
    const auto block =
        Philox::block(seed, {static_cast<std::uint32_t>(u), row, frame, static_cast<std::uint32_t>(Draw::grain)});
    for (std::size_t i = u; i < std::min(u + 16, grain.size()); ++i)
      grain[i] = static_cast<std::uint8_t>(block[(i - u) / 4] >> (8 * ((i - u) % 4)));
  }
}

}  // namespace

RenderedView shade(const Intrinsics& camera, const VisibilityBuffer& visible, const SceneGeometry& scene,
                   std::span<const Material> materials, std::uint64_t seed, std::uint32_t frame) {
  RenderedView view{Image<float>(camera.width, camera.height), Image<float>(camera.width, camera.height),
                    Image<std::uint8_t>(camera.width, camera.height, kNoSurface),
                    Image<Rgb>(camera.width, camera.height)};

  // Shade every triangle once.
  std::vector<TriangleShade> shades;
  shades.reserve(scene.triangles.size());
  for (const Triangle& t : scene.triangles) shades.push_back(shade_triangle(scene, t));

  // Compute every pixel from its triangle's shade.
  std::vector<std::uint8_t> grain(camera.width + 1);
  const auto inverse_fx = static_cast<float>(1 / camera.fx), inverse_fy = static_cast<float>(1 / camera.fy);
  for (int v = 0; v < camera.height; ++v) {
    fill_grain(seed, frame, static_cast<std::uint32_t>(v), grain);
    const float y = (static_cast<float>(v) - static_cast<float>(camera.cy)) * inverse_fy;
    for (int u = 0; u < camera.width; ++u) {
      const float noise = (static_cast<float>(grain[u] + grain[u + 1]) - 255.0f) * (1 / 48.0f);

      const std::uint32_t index = visible.triangle.at(u, v);
      if (index == kNoTriangle) {
        view.colour.at(u, v) = lit(kNothing, 1, noise);
        continue;
      }

      // Compute the visible point and its appearance.
      const float z = 1 / visible.inverse_z.at(u, v);
      const Eigen::Vector3f p(z * (static_cast<float>(u) - static_cast<float>(camera.cx)) * inverse_fx, z * y, z);
      view.depth.at(u, v) = z;
      view.cosine.at(u, v) = std::clamp(shades[index].cosine.at(p), 0.02f, 1.0f);
      view.surface.at(u, v) = scene.surface[index];
      view.colour.at(u, v) = lit(materials[scene.surface[index]].colour, shades[index].light.at(p), noise);
    }
  }
  return view;
}

}  // namespace barehand::synthetic
