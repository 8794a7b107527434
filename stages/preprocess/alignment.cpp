#include "stages/preprocess/alignment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace barehand {
namespace {

// Finds the translation of a predicted hand by moving its silhouette over the candidate cells.

constexpr int kBlock = 4;             // the first search works on blocks of this many cells per side
constexpr float kRing = 0.035f;       // width of a ring around the silhouette that should show no candidates [m]
constexpr float kOutside = -0.6f;     // weight of a candidate cell in the ring; inside the silhouette it is 1
constexpr float kBlur = 0.008f;       // width of the transition between the weights inside and in the ring [m]
constexpr float kHidden = 0.5f;       // value of a cell where a nearer surface could hide the hand; a candidate has 1
constexpr float kLeastScore = 0.3f;   // lowest score that is accepted; a perfect overlap has a score of 1
constexpr float kMotionCost = 0.25f;  // reduction of the score for the largest motion allowed

/// The silhouette of a hand as weights of cells: positive inside, negative in a ring around it, and zero beyond the
/// ring and on the forearm's side. Its first pixel is cell (u0, v0) of the grid.
struct Silhouette {
  int u0 = 0, v0 = 0;
  Image<float> weight;
  Image<float> z;              ///< depth of the skin, where weight > 0
  Eigen::AlignedBox2i inside;  ///< bounding box of the pixels where weight > 0
  float total = 0;             ///< sum of the positive weights
};

/// A capsule projected to the image.
struct ProjectedCapsule {
  Eigen::Vector2f a, axis;  ///< one end, and the vector to the other end [pixels]
  float inverse_length_sq, za, dz, radius, pixel_radius;
};

Eigen::Vector2f project(const Intrinsics& camera, const Eigen::Vector3f& p) {
  return camera.project(p.cast<double>()).cast<float>();
}

/// Distance and depth of the nearest capsule for every pixel of a row.
struct RowOfDistances {
  std::vector<float> distance;  ///< distance from the nearest capsule [pixels]; above `border` only an upper bound
  std::vector<float> z;         ///< depth of the nearest capsule's skin [m]

  void reset(int width) {
    distance.assign(width, INFINITY);
    z.assign(width, 0);
  }
  /// Adds a capsule. The row's first pixel is at (u0, v); distances above `border` pixels need not be exact.
  void add(const ProjectedCapsule& capsule, float u0, float v, float border) {
    const float reach = capsule.pixel_radius + border, y = v - capsule.a.y(), other_y = y - capsule.axis.y();
    if (std::min(y, other_y) > reach || std::max(y, other_y) < -reach) return;

    // Find the columns that the capsule reaches.
    const float low = capsule.a.x() + std::min(capsule.axis.x(), 0.f) - reach - u0;
    const float high = capsule.a.x() + std::max(capsule.axis.x(), 0.f) + reach - u0;
    const int begin = std::max(0, static_cast<int>(low));
    const int end = std::min(static_cast<int>(distance.size()), static_cast<int>(high) + 1);

    // Compute the distance of each pixel from the capsule's axis.
    const float ax = capsule.axis.x(), ay = capsule.axis.y(), start = u0 - capsule.a.x();
    float *nearest = distance.data(), *skin = z.data();
    for (int u = begin; u < end; ++u) {
      const float x = start + static_cast<float>(u);
      float t = (x * ax + y * ay) * capsule.inverse_length_sq;
      t = t < 0.f ? 0.f : t;
      t = t > 1.f ? 1.f : t;

      const float ex = x - t * ax, ey = y - t * ay;
      const float d = std::sqrt(ex * ex + ey * ey) - capsule.pixel_radius,
                  depth = capsule.za + t * capsule.dz - capsule.radius;

      // Keep the nearest capsule and the depth of its skin.
      const bool nearer = d < nearest[u];
      skin[u] = nearer ? depth : skin[u];
      nearest[u] = nearer ? d : nearest[u];
    }
  }
};

/// Draws silhouettes; reuses its memory.
class Drawer {
 public:
  /// Draws a hand. The silhouette is empty (total = 0) if the hand is too near or far outside the image.
  void draw(const PredictedHand& hand, const Intrinsics& camera, Silhouette& out);

 private:
  std::vector<ProjectedCapsule> projected_;
  RowOfDistances row_;
};

void Drawer::draw(const PredictedHand& hand, const Intrinsics& camera, Silhouette& out) {
  out.total = 0;
  projected_.clear();

  // Use one scale for the whole hand.
  const float depth = std::max(0.05f, hand.centre().z());
  const float per_metre = static_cast<float>(camera.fx) / depth;

  // Project the capsules, and find their bounding box.
  Eigen::Vector2f low(1e6f, 1e6f), high(-1e6f, -1e6f);
  for (const Capsule& c : hand.capsules()) {
    if (c.a.z() < 0.05f || c.b.z() < 0.05f) continue;
    const Eigen::Vector2f a = project(camera, c.a), b = project(camera, c.b), axis = b - a;
    projected_.push_back(
        {a, axis, 1 / std::max(axis.squaredNorm(), 1e-6f), c.a.z(), c.b.z() - c.a.z(), c.radius, c.radius * per_metre});
    low = low.cwiseMin(a).cwiseMin(b);
    high = high.cwiseMax(a).cwiseMax(b);
  }

  // Draw nothing if no capsule is in front of the camera, or if the projection is far larger than the image.
  const float border = (kRing + 0.02f) * per_metre;
  const int limit = 2 * (camera.width + camera.height);
  if (projected_.empty() || !(high - low).allFinite() || (high - low).maxCoeff() > static_cast<float>(limit)) return;

  // Reserve a border for the ring around the hand.
  out.u0 = static_cast<int>(std::floor(low.x() - border));
  out.v0 = static_cast<int>(std::floor(low.y() - border));
  const int width = static_cast<int>(high.x() + border) - out.u0 + 1;
  const int height = static_cast<int>(high.y() + border) - out.v0 + 1;
  out.weight.reset(width, height);
  out.z.reset(width, height);
  out.inside.setEmpty();

  // Draw row by row. The forearm continues behind the wrist, so the ring is left out there.
  const Eigen::Vector2f wrist = project(camera, hand.wrist());
  const Eigen::Vector2f arm = project(camera, hand.wrist() + 0.02f * hand.arm_axis()) - wrist;
  for (int v = 0; v < height; ++v) {
    row_.reset(width);
    for (const ProjectedCapsule& capsule : projected_)
      row_.add(capsule, static_cast<float>(out.u0), static_cast<float>(v + out.v0), kRing * per_metre);

    // Give each pixel its weight, which falls from 1 inside the hand to a negative value in the ring.
    for (int u = 0; u < width; ++u) {
      const float metres = row_.distance[u] / per_metre;
      const Eigen::Vector2f p(static_cast<float>(u + out.u0), static_cast<float>(v + out.v0));
      if (metres > kRing || (metres > 0 && (p - wrist).dot(arm) > 0)) continue;
      const float weight = std::clamp(1.f - metres / kBlur * (1.f - kOutside), kOutside, 1.f);

      // Store the weight, and add up the weights inside.
      out.weight.at(u, v) = weight;
      out.z.at(u, v) = row_.z[u];
      if (weight <= 0) continue;
      out.inside.extend(Eigen::Vector2i(u, v));
      out.total += weight;
    }
  }
}

/// The frame with which the silhouette is compared: cells that may be hand, and cells where a hand may be hidden.
struct Scene {
  Image<float> hand;      ///< fraction of a cell that may be hand
  Image<float> possible;  ///< `hand`, but kHidden where a nearer surface could hide the hand
  Image<float> table;     ///< sums of `possible` over all cells above and to the left of a cell (summed-area table)

  void sum_up() {
    table.reset(possible.width() + 1, possible.height() + 1);
    for (int v = 0; v < possible.height(); ++v) {
      float row = 0;
      for (int u = 0; u < possible.width(); ++u) {
        row += possible.at(u, v);
        table.at(u + 1, v + 1) = table.at(u + 1, v) + row;
      }
    }
  }
  /// Sum of `possible` over a rectangle that may reach beyond the image.
  float possible_in(const Eigen::AlignedBox2i& cells) const {
    const auto clamped = [](int x, int size) { return std::clamp(x, 0, size - 1); };
    const int u0 = clamped(cells.min().x(), table.width()), u1 = clamped(cells.max().x() + 1, table.width());
    const int v0 = clamped(cells.min().y(), table.height()), v1 = clamped(cells.max().y() + 1, table.height());
    return table.at(u1, v1) - table.at(u0, v1) - table.at(u1, v0) + table.at(u0, v0);
  }
};

float overlap(const Silhouette& shape, const Scene& scene, int du, int dv) {
  const int width = scene.hand.width(), height = scene.hand.height();

  // Visit only the part of the silhouette that lies in the image.
  const int u0 = std::max(0, -(shape.u0 + du)), u1 = std::min(shape.weight.width(), width - shape.u0 - du);
  const int v0 = std::max(0, -(shape.v0 + dv)), v1 = std::min(shape.weight.height(), height - shape.v0 - dv);
  float sum[8] = {};  // eight partial sums, so that the loop vectorises with a fixed order of additions
  for (int v = v0; v < v1; ++v) {
    const float* w = shape.weight.row(v);
    const float* hand = scene.hand.row(v + shape.v0 + dv) + shape.u0 + du;
    const float* possible = scene.possible.row(v + shape.v0 + dv) + shape.u0 + du;

    // Inside the silhouette, pixels where the hand may be hidden count, too; in the ring, only visible hand pixels do.
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

/// The best shift within +-range around (du, dv), in steps of `step` [cells]. The score decreases with the length of
/// the shift, by kMotionCost at `free_range` cells.
Shift search(const Silhouette& shape, const Scene& scene, int du, int dv, int range, int step, float free_range) {
  Shift best;

  // Compute the score of each shift in a row; a longer motion costs more.
  const auto search_row = [&](int y) {
    for (int x = du - range; x <= du + range; x += step) {
      const float motion = std::hypot(static_cast<float>(x), static_cast<float>(y)) / std::max(free_range, 1.f);
      const float cost = kMotionCost * motion;

      const Eigen::AlignedBox2i inside = shape.inside.translated(Eigen::Vector2i(shape.u0 + x, shape.v0 + y));
      if (scene.possible_in(inside) / shape.total - cost <= best.score) continue;  // an upper bound of the score
      const float score = overlap(shape, scene, x, y) / shape.total - cost;
      if (score > best.score) best = {x, y, score};
    }
  };

  // Search from the middle row outwards.
  search_row(dv);  // the row of the initial guess first, since most hands hardly move
  for (int y = step; y <= range; y += step) {
    search_row(dv - y);
    search_row(dv + y);
  }
  return best;
}

void average_blocks(const Image<float>& cells, Image<float>& blocks) {
  blocks.reset((cells.width() + kBlock - 1) / kBlock, (cells.height() + kBlock - 1) / kBlock);
  for (int v = 0; v < cells.height(); ++v)
    for (int u = 0; u < cells.width(); ++u)
      blocks.at(u / kBlock, v / kBlock) += cells.at(u, v) / static_cast<float>(kBlock * kBlock);
}

}  // namespace

struct TranslationSearch::Buffers {
  Drawer drawer;
  Scene scene, blocks;
  Silhouette fine, rough;
  std::vector<float> steps;
};

TranslationSearch::TranslationSearch() : buffers_(std::make_unique<Buffers>()) {}
TranslationSearch::~TranslationSearch() = default;

std::optional<Eigen::Vector3f> TranslationSearch::find(const PredictedHand& hand, const CoarseGrid& grid,
                                                       const Image<std::uint8_t>& mask, double reach) {
  auto& [drawer, scene, blocks, fine, rough, steps] = *buffers_;
  const Intrinsics& camera = grid.camera;
  const float z0 = hand.centre().z();
  if (!(z0 > 0.05f)) return std::nullopt;
  // Use only candidates near the hand's depth: a hand moves less in depth than across the image.
  const float depth_gate = 0.10f + 0.4f * static_cast<float>(reach);
  scene.hand.reset(mask.width(), mask.height());
  scene.possible.reset(mask.width(), mask.height());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const float z = grid.z[i];
    scene.hand[i] = mask[i] && std::abs(z - z0) < depth_gate ? 1.f : 0.f;
    scene.possible[i] = scene.hand[i] > 0 ? 1.f : z > 0 && z < z0 ? kHidden : 0.f;
  }

  // Average over blocks of cells for the rough search, and prepare both scenes for the upper bounds of scores.
  average_blocks(scene.hand, blocks.hand);
  average_blocks(scene.possible, blocks.possible);
  scene.sum_up();
  blocks.sum_up();

  // Draw the silhouette at both resolutions.
  const double s = kBlock, half = (s - 1) / 2;
  const Intrinsics block_camera{blocks.hand.width(), blocks.hand.height(),   camera.fx / s,
                                camera.fy / s,       (camera.cx - half) / s, (camera.cy - half) / s};
  drawer.draw(hand, block_camera, rough);
  drawer.draw(hand, camera, fine);
  if (rough.total <= 0 || fine.total <= 0) return std::nullopt;

  // Search roughly at first, then around the best shift.
  const float range = std::min(static_cast<float>(reach * camera.fx) / z0, static_cast<float>(camera.width));
  const int block_range = static_cast<int>(std::ceil(range / kBlock));
  const Shift block = search(rough, blocks, 0, 0, block_range, 1, range / kBlock);
  const Shift near = search(fine, scene, block.du * kBlock, block.dv * kBlock, kBlock, 2, range);
  const Shift cell = search(fine, scene, near.du, near.dv, 1, 1, range);
  if (cell.score < kLeastScore) return std::nullopt;

  // Take the motion in depth from the cells inside the silhouette.
  steps.clear();
  for (int v = 0; v < fine.weight.height(); ++v)
    for (int u = 0; u < fine.weight.width(); ++u) {
      const int x = u + fine.u0 + cell.du, y = v + fine.v0 + cell.dv;
      if (fine.weight.at(u, v) > 0.5f && scene.hand.contains(x, y) && scene.hand.at(x, y) > 0)
        steps.push_back(grid.z.at(x, y) - fine.z.at(u, v));
    }
  if (steps.empty()) return std::nullopt;
  std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());

  // Convert the shift in the image and in depth to a translation.
  const Eigen::Vector2d centre = camera.project(hand.centre().cast<double>());
  const Eigen::Vector3d moved =
      camera.unproject(centre.x() + cell.du, centre.y() + cell.dv, z0 + steps[steps.size() / 2]);
  return (moved - hand.centre().cast<double>()).cast<float>();
}

}  // namespace barehand
