#include "stages/preprocess/alignment.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace barehand {
namespace {

constexpr int kBlock = 4;             // cells per side of a block of the first search
constexpr float kRing = 0.035f;       // m around the silhouette that should be empty
constexpr float kOutside = -0.6f;     // weight of a candidate there
constexpr float kBlur = 0.008f;       // m over which the weight falls from inside to outside
constexpr float kHidden = 0.5f;       // worth of a place where something nearer could hide the hand
constexpr float kLeastScore = 0.3f;   // of a perfect overlap
constexpr float kMotionCost = 0.15f;  // of a perfect overlap, for the largest motion allowed

/// Weights over the image: positive where the hand would be seen, negative beside it, zero elsewhere.
struct Silhouette {
  int u0 = 0, v0 = 0;
  Image<float> weight;
  Image<float> z;  ///< depth of the skin, where weight > 0
  float total = 0;
};

struct Projected {
  Eigen::Vector2f a, b;
  float za, zb, radius, pixel_radius;
};

Eigen::Vector2f project(const Intrinsics& camera, const Eigen::Vector3f& p) {
  return camera.project(p.cast<double>()).cast<float>();
}

Silhouette draw(const PredictedHand& hand, const Intrinsics& camera) {
  std::vector<Projected> rods;
  const float depth = std::max(0.05f, hand.centre().z());
  const float per_metre = static_cast<float>(camera.fx) / depth;
  Eigen::Vector2f low(1e6f, 1e6f), high(-1e6f, -1e6f);
  for (const Capsule& c : hand.capsules()) {
    if (c.a.z() < 0.05f || c.b.z() < 0.05f) continue;
    rods.push_back({project(camera, c.a), project(camera, c.b), c.a.z(), c.b.z(), c.radius, c.radius * per_metre});
    for (const Eigen::Vector2f& p : {rods.back().a, rods.back().b}) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  Silhouette out;
  const float border = (kRing + 0.02f) * per_metre;
  const int limit = 2 * (camera.width + camera.height);
  if (rods.empty() || !(high - low).allFinite() || (high - low).maxCoeff() > static_cast<float>(limit)) return out;
  out.u0 = static_cast<int>(std::floor(low.x() - border));
  out.v0 = static_cast<int>(std::floor(low.y() - border));
  const int width = static_cast<int>(high.x() + border) - out.u0 + 1;
  const int height = static_cast<int>(high.y() + border) - out.v0 + 1;
  out.weight.reset(width, height);
  out.z.reset(width, height);
  const Eigen::Vector2f wrist = project(camera, hand.wrist());
  const Eigen::Vector2f arm = project(camera, hand.wrist() + 0.02f * hand.arm_axis()) - wrist;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector2f p(static_cast<float>(u + out.u0), static_cast<float>(v + out.v0));
      float nearest = INFINITY, z = 0;
      for (const Projected& rod : rods) {
        const Eigen::Vector2f axis = rod.b - rod.a;
        const float t = std::clamp((p - rod.a).dot(axis) / std::max(axis.squaredNorm(), 1e-6f), 0.f, 1.f);
        const float d = (p - rod.a - t * axis).norm() - rod.pixel_radius;
        if (d >= nearest) continue;
        nearest = d;
        z = rod.za + t * (rod.zb - rod.za) - rod.radius;
      }
      const float metres = nearest / per_metre;
      if (metres > kRing || (metres > 0 && (p - wrist).dot(arm) > 0)) continue;
      const float weight = std::clamp(1.f - metres / kBlur * (1.f - kOutside), kOutside, 1.f);
      out.weight.at(u, v) = weight;
      out.z.at(u, v) = z;
      out.total += std::max(weight, 0.f);
    }
  return out;
}

/// What the silhouette is laid over: cells that may be hand, and cells where a hand may be hidden.
struct Scene {
  Image<float> hand;      ///< share of a cell that may be hand
  Image<float> possible;  ///< the same, plus kHidden where something nearer could hide it
};

float overlap(const Silhouette& shape, const Scene& scene, int du, int dv) {
  const int width = scene.hand.width(), height = scene.hand.height();
  const int u0 = std::max(0, -(shape.u0 + du)), u1 = std::min(shape.weight.width(), width - shape.u0 - du);
  const int v0 = std::max(0, -(shape.v0 + dv)), v1 = std::min(shape.weight.height(), height - shape.v0 - dv);
  float sum[8] = {};  // eight partial sums: the order of additions is fixed and vectorises
  for (int v = v0; v < v1; ++v) {
    const float* w = shape.weight.row(v);
    const float* hand = scene.hand.row(v + shape.v0 + dv) + shape.u0 + du;
    const float* possible = scene.possible.row(v + shape.v0 + dv) + shape.u0 + du;
    int u = u0;
    for (; u + 8 <= u1; u += 8)
      for (int k = 0; k < 8; ++k) sum[k] += w[u + k] * (w[u + k] > 0 ? possible[u + k] : hand[u + k]);
    for (; u < u1; ++u) sum[0] += w[u] * (w[u] > 0 ? possible[u] : hand[u]);
  }
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

struct Shift {
  int du = 0, dv = 0;
  float score = -INFINITY;
};

/// Best shift within +-range around (du, dv); short motions win ties.
Shift search(const Silhouette& shape, const Scene& scene, int du, int dv, int range, float free_range) {
  Shift best;
  for (int y = dv - range; y <= dv + range; ++y)
    for (int x = du - range; x <= du + range; ++x) {
      const float motion = std::hypot(static_cast<float>(x), static_cast<float>(y)) / std::max(free_range, 1.f);
      const float score = overlap(shape, scene, x, y) / shape.total - kMotionCost * motion;
      if (score > best.score) best = {x, y, score};
    }
  return best;
}

Image<float> blocks_of(const Image<float>& cells) {
  Image<float> blocks((cells.width() + kBlock - 1) / kBlock, (cells.height() + kBlock - 1) / kBlock);
  for (int v = 0; v < cells.height(); ++v)
    for (int u = 0; u < cells.width(); ++u)
      blocks.at(u / kBlock, v / kBlock) += cells.at(u, v) / static_cast<float>(kBlock * kBlock);
  return blocks;
}

}  // namespace

std::optional<Eigen::Vector3f> align_translation(const PredictedHand& hand, const CoarseGrid& grid,
                                                 const Image<std::uint8_t>& mask, double reach) {
  const Intrinsics& camera = grid.camera;
  const float z0 = hand.centre().z();
  if (!(z0 > 0.05f)) return std::nullopt;
  // Towards the camera a hand moves less than across, and what is far from its depth is something else.
  const float depth_gate = 0.10f + 0.4f * static_cast<float>(reach);
  Scene scene{Image<float>(mask.width(), mask.height()), Image<float>(mask.width(), mask.height())};
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const float z = grid.z[i];
    scene.hand[i] = mask[i] && std::abs(z - z0) < depth_gate ? 1.f : 0.f;
    scene.possible[i] = scene.hand[i] > 0 ? 1.f : z > 0 && z < z0 ? kHidden : 0.f;
  }
  const Scene blocks{blocks_of(scene.hand), blocks_of(scene.possible)};
  const double s = kBlock, half = (s - 1) / 2;
  const Intrinsics block_camera{blocks.hand.width(), blocks.hand.height(),   camera.fx / s,
                                camera.fy / s,       (camera.cx - half) / s, (camera.cy - half) / s};
  const Silhouette rough = draw(hand, block_camera), fine = draw(hand, camera);
  if (rough.total <= 0 || fine.total <= 0) return std::nullopt;
  const float range = std::min(static_cast<float>(reach * camera.fx) / z0, static_cast<float>(camera.width));
  const int block_range = static_cast<int>(std::ceil(range / kBlock));
  const Shift block = search(rough, blocks, 0, 0, block_range, range / kBlock);
  const Shift cell = search(fine, scene, block.du * kBlock, block.dv * kBlock, kBlock, range);
  if (cell.score < kLeastScore) return std::nullopt;

  std::vector<float> steps;
  for (int v = 0; v < fine.weight.height(); ++v)
    for (int u = 0; u < fine.weight.width(); ++u) {
      const int x = u + fine.u0 + cell.du, y = v + fine.v0 + cell.dv;
      if (fine.weight.at(u, v) > 0.5f && scene.hand.contains(x, y) && scene.hand.at(x, y) > 0)
        steps.push_back(grid.z.at(x, y) - fine.z.at(u, v));
    }
  if (steps.empty()) return std::nullopt;
  std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());
  const Eigen::Vector2d centre = camera.project(hand.centre().cast<double>());
  const Eigen::Vector3d moved =
      camera.unproject(centre.x() + cell.du, centre.y() + cell.dv, z0 + steps[steps.size() / 2]);
  return (moved - hand.centre().cast<double>()).cast<float>();
}

}  // namespace barehand
