#include "stages/preprocess/normals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stages/preprocess/coarse_grid.h"

namespace barehand {
namespace {

// Fits normals to the hand's surface, and estimates the depth noise.

constexpr int kFewestSamples = 6;      // fewer samples do not determine a plane
constexpr float kSteepest = 1.2f;      // samples up to this slope from the centre count as the same surface
constexpr float kLeastFacing = 0.05f;  // smallest cosine to the view ray; at grazing angles the fit is mostly noise

constexpr int kLanes = 8;               // number of neighbouring pixels that are fitted together
constexpr int kMostSpacing = 12;        // largest distance between samples [pixels]
constexpr int kPad = 2 * kMostSpacing;  // reach of the samples, hence width of the border [pixels]
constexpr float kNoHand = -1e3f;        // depth of pixels outside the hand: so far away that every gate rejects it [m]

using Lanes = std::array<float, kLanes>;

/// Fits planes around kLanes neighbouring pixels of a row, and returns their slopes in metres per sample. `z` points to
/// the first pixel in an image with `stride` floats per row. `valid` = 1 where enough samples agree.
void fit_slopes(const float* z, int stride, int spacing, float gate, Lanes& slope_u, Lanes& slope_v, Lanes& valid) {
  // Sum up the moments of 5 x 5 samples around each pixel; those beyond the gate lie on another surface.
  Lanes n{}, su{}, sv{}, suu{}, suv{}, svv{}, sz{}, suz{}, svz{};
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      const float* sample = z + j * spacing * stride + i * spacing;
      const float fi = static_cast<float>(i), fj = static_cast<float>(j);

      for (int k = 0; k < kLanes; ++k) {
        const float dz = sample[k] - z[k];
        const float w = std::abs(dz) < gate ? 1.f : 0.f, wz = w > 0 ? dz : 0.f;
        n[k] += w;
        su[k] += fi * w;
        sv[k] += fj * w;
        suu[k] += fi * fi * w;
        suv[k] += fi * fj * w;
        svv[k] += fj * fj * w;

        sz[k] += wz;
        suz[k] += fi * wz;
        svz[k] += fj * wz;
      }
    }

  // Subtract the means, and solve for the slopes.
  for (int k = 0; k < kLanes; ++k) {
    const float m = 1.f / std::max(n[k], 1.f);
    const float cuu = suu[k] - su[k] * su[k] * m, cuv = suv[k] - su[k] * sv[k] * m, cvv = svv[k] - sv[k] * sv[k] * m;
    const float cuz = suz[k] - su[k] * sz[k] * m, cvz = svz[k] - sv[k] * sz[k] * m;
    const float det = cuu * cvv - cuv * cuv;

    valid[k] = n[k] >= kFewestSamples && det >= 1.f ? 1.f : 0.f;  // det = 0: all samples are on a line
    const float inverse = 1.f / std::max(det, 1.f);
    slope_u[k] = (cuz * cvv - cvz * cuv) * inverse;
    slope_v[k] = (cvz * cuu - cuz * cuv) * inverse;
  }
}

/// Unit normal of the surface z(u, v) at the ray (x, y, 1): the cross product of the tangents, divided by z. `a` and
/// `b` are the slopes per pixel along u and v, times the focal length. Zero if the surface is seen edge-on.
Eigen::Vector3f normal_of(float x, float y, float z, float a, float b) {
  const Eigen::Vector3f normal = Eigen::Vector3f(a, b, -(z + a * x + b * y)).normalized();
  const bool faces = normal.dot(Eigen::Vector3f(x, y, 1.f).normalized()) < -kLeastFacing;
  return faces ? normal : Eigen::Vector3f(Eigen::Vector3f::Zero());
}

}  // namespace

void NormalFitter::fit(const Image<std::uint8_t>& mask, double radius, HandObservation& out) {
  const Intrinsics& camera = out.frame->camera;
  const int width = mask.width(), height = mask.height();
  out.normal.reset(width, height, Eigen::Vector3f::Zero());

  // Copy the hand into an image with a border, so that samples exist on all sides.
  padded_.reset(width + 2 * kPad + kLanes, height + 2 * kPad, kNoHand);
  for (const std::int32_t i : out.hand_pixels) padded_.at(i % width + kPad, i / width + kPad) = out.depth[i];
  const float fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  Lanes slope_u, slope_v, valid;

  // Fit the planes of kLanes neighbouring pixels at once.
  for (int v = 0; v < height; ++v) {
    const std::uint8_t* hand = mask.row(v);
    for (int u = 0; u < width; ++u) {
      if (!hand[u]) continue;
      const float* z = padded_.row(v + kPad) + u + kPad;
      const int spacing =
          std::clamp(static_cast<int>(static_cast<float>(radius) * fx / *z / 2 + 0.5f), 1, kMostSpacing);
      const float gate = same_surface_step(*z, fx) + kSteepest * static_cast<float>(2 * spacing) * *z / fx;
      fit_slopes(z, padded_.width(), spacing, gate, slope_u, slope_v, valid);

      // Convert the slopes to normals.
      const float y = static_cast<float>((v + out.v0 - camera.cy) / camera.fy);
      const int lanes = std::min(kLanes, width - u);
      for (int k = 0; k < lanes; ++k) {
        if (!hand[u + k] || valid[k] == 0) continue;
        const float x = static_cast<float>((u + k + out.u0 - camera.cx) / camera.fx);
        const float per_pixel = 1.f / static_cast<float>(spacing);
        out.normal.at(u + k, v) = normal_of(x, y, z[k], slope_u[k] * fx * per_pixel, slope_v[k] * fy * per_pixel);
      }
      u += lanes - 1;
    }
  }
}

double NoiseMeter::measure(const Image<std::uint8_t>& mask, const Image<float>& depth, double floor) {
  constexpr int kSpan = 6;  // width of a third difference over every second pixel [pixels]
  // Converts the median absolute third difference to a standard deviation: 1.4826 holds for normally distributed noise,
  // and a third difference has sqrt(1 + 9 + 9 + 1) = 4.4721 times the noise of a pixel.
  constexpr double kToSigma = 1.4826 / 4.4721;
  constexpr std::size_t kFewest = 50;

  // Collect third differences of the depth, which do not change with the slope and curvature of the surface.
  differences_.clear();
  for (int v = 0; v < mask.height(); v += 2) {
    const std::uint8_t* hand = mask.row(v);
    const float* z = depth.row(v);
    for (int u = 0; u + kSpan < mask.width(); u += 2)
      if (hand[u] & hand[u + 2] & hand[u + 4] & hand[u + 6])
        differences_.push_back(std::abs(z[u] - 3 * z[u + 2] + 3 * z[u + 4] - z[u + 6]));
  }
  if (differences_.size() < kFewest) return floor;

  // Estimate the standard deviation by the median, which edges of the surface hardly affect.
  const auto middle = differences_.begin() + differences_.size() / 2;
  std::nth_element(differences_.begin(), middle, differences_.end());
  return std::max(floor, kToSigma * *middle);
}

}  // namespace barehand
