// Simulates the noise of depth sensors.
#include "drivers/synthetic/rendering/depth_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "drivers/synthetic/random_keys.h"
#include "drivers/synthetic/rendering/depth_loss.h"
#include "math/random.h"

namespace barehand::synthetic {
namespace {

using Block = std::array<std::uint32_t, 4>;

/// Random bits for one pixel of one frame.
Block draw(std::uint64_t seed, std::uint32_t frame, std::uint32_t u, std::uint32_t v, Draw purpose) {
  return Philox::block(seed, {u, v, frame, static_cast<std::uint32_t>(purpose)});
}

/// Depth at a position between pixels: bilinear on a surface, that of the nearest pixel at an edge.
float sample(const Image<float>& depth, float u, float v) {
  const int u0 = std::clamp(static_cast<int>(std::floor(u)), 0, depth.width() - 2);
  const int v0 = std::clamp(static_cast<int>(std::floor(v)), 0, depth.height() - 2);
  const float a = std::clamp(u - static_cast<float>(u0), 0.0f, 1.0f);
  const float b = std::clamp(v - static_cast<float>(v0), 0.0f, 1.0f);
  const float *top = depth.row(v0) + u0, *low = depth.row(v0 + 1) + u0;
  const auto [lo, hi] = std::minmax({top[0], top[1], low[0], low[1]});
  if (lo <= 0 || hi - lo > 0.01f) return (b < 0.5f ? top : low)[a < 0.5f ? 0 : 1];
  return (1 - b) * ((1 - a) * top[0] + a * top[1]) + b * ((1 - a) * low[0] + a * low[1]);
}

/// Lateral sigma [px], which grows with the angle between the line of sight and the surface normal (Nguyen et al. 2012,
/// Eq. 1).
float lateral_sigma(const KinectNoise& noise, float cosine) {
  const float angle = std::min(std::acos(cosine), 1.45f);
  return static_cast<float>(noise.lateral) + 0.035f * angle / (static_cast<float>(std::numbers::pi / 2) - angle);
}

/// Random numbers in [0, 1), one for each patch of 6 x 6 pixels: pixels are lost patch by patch.
class Patches {
 public:
  Patches(int width, int height, std::uint64_t seed, std::uint32_t frame)
      : numbers_(width / kSize + 2 * kBorder, height / kSize + 2 * kBorder) {
    for (int v = 0; v < numbers_.height(); ++v)
      for (int u = 0; u < numbers_.width(); ++u) {
        const Block bits = draw(seed, frame, static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v), Draw::holes);
        numbers_.at(u, v) = static_cast<float>(Philox::uniform(bits[0]));
      }
  }
  /// The random number of the patch at a position, which may lie some pixels outside the image.
  float at(float u, float v) const {
    return numbers_.at(kBorder + static_cast<int>(std::floor(u / kSize)),
                       kBorder + static_cast<int>(std::floor(v / kSize)));
  }

 private:
  static constexpr int kSize = 6, kBorder = 3;
  Image<float> numbers_;
};

/// Depth of the nearest and the farthest surface among a pixel and its four neighbours.
std::pair<float, float> depth_range(const Image<float>& depth, int u, int v) {
  float lo = depth.at(u, v), hi = lo;
  for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    if (!depth.contains(u + du, v + dv)) continue;
    const float z = depth.at(u + du, v + dv);
    if (z > 0) lo = std::min(lo, z), hi = std::max(hi, z);
  }
  return {lo, hi};
}

}  // namespace

DepthNoise::DepthNoise() {
  // Invert the normal distribution function by bisection.
  for (int i = 0; i < 4096; ++i) {
    const double p = (i + 0.5) / 4096;
    double lo = -5, hi = 5;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (lo + hi);
      (0.5 * std::erfc(-middle / std::numbers::sqrt2) < p ? lo : hi) = middle;
    }
    quantiles_[i] = static_cast<float>(lo);
  }
}

double kinect_axial_sigma(const KinectNoise& noise, double z) {
  return noise.axial + noise.axial_growth * (z - 0.4) * (z - 0.4);
}

Image<float> DepthNoise::kinect(const Intrinsics& camera, const RenderedView& view, std::span<const Material> materials,
                                const KinectNoise& noise, std::uint64_t seed, std::uint32_t frame) const {
  Image<float> noisy(view.depth.width(), view.depth.height(), 0.0f);
  const Patches patches(view.depth.width(), view.depth.height(), seed, frame);
  std::vector<bool> lit;

  // Process the image row by row; pixels in the projector's shadow have no depth.
  for (int v = 0; v < view.depth.height(); ++v) {
    lit_by_projector(camera, noise.baseline, view.depth.row(v), lit);
    for (int u = 0; u < view.depth.width(); ++u) {
      if (view.depth.at(u, v) <= 0 || !lit[u]) continue;
      const Block bits =
          draw(seed, frame, static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v), Draw::depth_noise);
      const float n0 = normal(bits[0]), n1 = normal(bits[0] >> 16), n2 = normal(bits[1]);

      // Pixels are lost at depth edges.
      if (Philox::uniform(bits[2]) < edge_loss(view.depth, u, v)) continue;
      // Patches are lost on difficult surfaces. Jitter of the position gives them ragged outlines.
      const float u_patch = static_cast<float>(u) + 1.5f * normal(bits[1] >> 16);
      const float v_patch = static_cast<float>(v) + 1.5f * normal(bits[3]);
      if (patches.at(u_patch, v_patch) < surface_loss(view, materials, u, v)) continue;

      // All other pixels get lateral and axial noise.
      const float lateral = lateral_sigma(noise, view.cosine.at(u, v));
      const float z = sample(view.depth, static_cast<float>(u) + lateral * n0, static_cast<float>(v) + lateral * n1);
      if (z > 0) noisy.at(u, v) = z + static_cast<float>(kinect_axial_sigma(noise, z)) * n2;
    }
  }
  return noisy;
}

Image<float> DepthNoise::tof(const RenderedView& view, const TofNoise& noise, std::uint64_t seed,
                             std::uint32_t frame) const {
  Image<float> noisy(view.depth.width(), view.depth.height(), 0.0f);
  for (int v = 0; v < view.depth.height(); ++v)
    for (int u = 0; u < view.depth.width(); ++u) {
      float z = view.depth.at(u, v);

      if (z <= 0) continue;
      const Block bits =
          draw(seed, frame, static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v), Draw::depth_noise);

      // At a depth edge, some pixels lie between both surfaces ("flying pixels").
      const auto [lo, hi] = depth_range(view.depth, u, v);
      const bool flies = hi - lo > 0.015f && Philox::uniform(bits[1]) < noise.flying;
      if (flies) z = lo + static_cast<float>(Philox::uniform(bits[2])) * (hi - lo);

      // The less light returns, the larger the noise. Infrared reflectance roughly follows the colour. The returned
      // light is 1 for a white surface at 0.5 m that faces the camera.
      const Rgb c = view.colour.at(u, v);
      const float albedo = std::max(0.05f, static_cast<float>(c.r + c.g + c.b) / 765.0f);
      const float returned = albedo * view.cosine.at(u, v) / (4 * z * z);
      if (returned < 0.004f) continue;  // too little light returns for a measurement
      noisy.at(u, v) = z + static_cast<float>(noise.axial) / std::sqrt(returned) * normal(bits[0]);
    }
  return noisy;
}

}  // namespace barehand::synthetic
