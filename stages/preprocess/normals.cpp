#include "stages/preprocess/normals.h"

#include <algorithm>
#include <cmath>

#include "stages/preprocess/coarse_grid.h"

namespace barehand {
namespace {

constexpr int kFewestSamples = 6;
constexpr float kSteepest = 1.2f;      // slope up to which samples away from the centre count as the same surface
constexpr float kLeastFacing = 0.05f;  // cosine to the view ray; beyond it the fit is made of noise

/// Slope of the fitted plane in metres per pixel, around the depth z of its centre pixel.
bool fit_slope(const Image<std::uint8_t>& mask, const Image<float>& depth, int u, int v, int spacing, float gate,
               float slopes[2]) {
  const float z = depth.at(u, v);
  float n = 0, su = 0, sv = 0, suu = 0, suv = 0, svv = 0, sz = 0, suz = 0, svz = 0;
  for (int j = -2; j <= 2; ++j) {
    const int y = v + j * spacing;
    if (y < 0 || y >= depth.height()) continue;
    const std::uint8_t* hand = mask.row(y);
    const float* row = depth.row(y);
    for (int i = -2; i <= 2; ++i) {
      const int x = u + i * spacing;
      if (x < 0 || x >= depth.width()) continue;
      const float dz = row[x] - z;
      const float w = hand[x] && std::abs(dz) < gate ? 1.f : 0.f;
      const float wi = w * static_cast<float>(i), wj = w * static_cast<float>(j);
      n += w;
      su += wi;
      sv += wj;
      suu += wi * static_cast<float>(i);
      suv += wi * static_cast<float>(j);
      svv += wj * static_cast<float>(j);
      sz += w * dz;
      suz += wi * dz;
      svz += wj * dz;
    }
  }
  if (n < kFewestSamples) return false;
  const float cuu = suu - su * su / n, cuv = suv - su * sv / n, cvv = svv - sv * sv / n;
  const float cuz = suz - su * sz / n, cvz = svz - sv * sz / n;
  const float det = cuu * cvv - cuv * cuv;
  if (det < 1.f) return false;  // samples on a line
  slopes[0] = (cuz * cvv - cvz * cuv) / (det * static_cast<float>(spacing));
  slopes[1] = (cvz * cuu - cuz * cuv) / (det * static_cast<float>(spacing));
  return true;
}

}  // namespace

void fit_normals(const Image<std::uint8_t>& mask, double radius, HandObservation& out) {
  const Intrinsics& camera = out.frame->camera;
  const float fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  out.normal.reset(mask.width(), mask.height(), Eigen::Vector3f::Zero());
  for (const std::int32_t index : out.hand_pixels) {
    const int u = index % mask.width(), v = index / mask.width();
    const float z = out.depth[index];
    const int spacing = std::max(1, static_cast<int>(std::lround(radius * camera.fx / z / 2)));
    const float gate = same_surface_step(z, fx) + kSteepest * static_cast<float>(2 * spacing) * z / fx;
    float slopes[2];
    if (!fit_slope(mask, out.depth, u, v, spacing, gate, slopes)) continue;
    // Surface z(u, v) with point z * (x, y, 1): tangents crossed, divided by z.
    const float x = static_cast<float>((u + out.u0 - camera.cx) / camera.fx);
    const float y = static_cast<float>((v + out.v0 - camera.cy) / camera.fy);
    const float a = slopes[0] * fx, b = slopes[1] * fy;
    const Eigen::Vector3f normal(a, b, -(z + a * x + b * y));
    const Eigen::Vector3f unit = normal.normalized();
    if (unit.dot(Eigen::Vector3f(x, y, 1.f).normalized()) < -kLeastFacing) out.normal[index] = unit;
  }
}

double measure_noise(const Image<std::uint8_t>& mask, const Image<float>& depth, double floor) {
  constexpr int kSpan = 6;                      // third difference of every second pixel
  constexpr double kToSigma = 1.4826 / 4.4721;  // median absolute value to sigma; sqrt(1 + 9 + 9 + 1)
  constexpr std::size_t kFewest = 50;
  std::vector<float> differences;
  for (int v = 0; v < mask.height(); v += 2) {
    const std::uint8_t* hand = mask.row(v);
    const float* z = depth.row(v);
    for (int u = 0; u + kSpan < mask.width(); u += 2)
      if (hand[u] & hand[u + 2] & hand[u + 4] & hand[u + 6])
        differences.push_back(std::abs(z[u] - 3 * z[u + 2] + 3 * z[u + 4] - z[u + 6]));
  }
  if (differences.size() < kFewest) return floor;
  const auto middle = differences.begin() + differences.size() / 2;
  std::nth_element(differences.begin(), middle, differences.end());
  return std::max(floor, kToSigma * *middle);
}

}  // namespace barehand
