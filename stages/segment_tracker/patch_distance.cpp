// The distance between a segment's skin and the data (paper, Sec. 4).
#include "stages/segment_tracker/patch_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel/simd.h"

namespace barehand {
namespace {

constexpr int kBlock = 64;  // points per block: their intermediate results fit into the first-level cache

/// Intermediate results for a block of skin points.
struct Block {
  std::array<float, kBlock> x, y, z,       ///< position in the camera frame [m]
      weight;                              ///< number of pixels that the point covers; 0 if it faces away
  std::array<std::int32_t, kBlock> pixel;  ///< index of the pixel in the map
  std::array<PixelMap::Cell, kBlock> cell;
  std::array<std::int32_t, kBlock> hidden;  ///< PixelMap::hidden at the pixel
};

/// The sample's pose and the camera in single precision.
struct View {
  Eigen::Matrix3f R;
  Eigen::Vector3f t, origin;
  float fx, fy, cx, cy, last_u, last_v;
  std::int32_t width;

  View(const SE3& T, const PixelMap& map)
      : R(T.R.cast<float>()),
        t(T.t.cast<float>()),
        origin(R.transpose() * t),
        fx(map.fx),
        fy(map.fy),
        cx(map.cx + 0.5f),  // with this offset, truncation to an integer rounds to the nearest pixel
        cy(map.cy + 0.5f),
        last_u(static_cast<float>(map.width - 1)),
        last_v(static_cast<float>(map.height - 1)),
        width(map.width) {}
};

/// Projects a block of skin points into the image.
inline void project(const SegmentSurface& skin, int begin, int n, const View& view, Block& out) {
  // Load everything that does not depend on the point.
  const float *x = skin.x.data() + begin, *y = skin.y.data() + begin, *z = skin.z.data() + begin;
  const float *nx = skin.nx.data() + begin, *ny = skin.ny.data() + begin, *nz = skin.nz.data() + begin;
  const float* area = skin.area.data() + begin;
  const Eigen::Matrix3f& R = view.R;
  const float r00 = R(0, 0), r01 = R(0, 1), r02 = R(0, 2), r10 = R(1, 0), r11 = R(1, 1), r12 = R(1, 2);
  const float r20 = R(2, 0), r21 = R(2, 1), r22 = R(2, 2), tx = view.t[0], ty = view.t[1], tz = view.t[2];
  const float ox = view.origin[0], oy = view.origin[1], oz = view.origin[2];
  const float fx = view.fx, fy = view.fy, pixels = fx * fy, cx = view.cx, cy = view.cy;
  const float last_u = view.last_u, last_v = view.last_v;
  const std::int32_t width = view.width;

#pragma omp simd
  for (int i = 0; i < n; ++i) {
    const float px = r00 * x[i] + r01 * y[i] + r02 * z[i] + tx;
    const float py = r10 * x[i] + r11 * y[i] + r12 * z[i] + ty;
    const float pz = r20 * x[i] + r21 * y[i] + r22 * z[i] + tz;
    // The angle to the line of sight needs only a scalar product: n_camera . p_camera = n . (p + R^T t).
    const float away = nx[i] * (x[i] + ox) + ny[i] * (y[i] + oy) + nz[i] * (z[i] + oz);
    const float inv = 1.0f / (pz > kNearestSeen ? pz : kNearestSeen);
    // A point with an area covers f^2 area (-n.p) / z^3 pixels of the image.
    const bool front = (away < 0.0f) & (pz > kNearestSeen);
    out.weight[i] = front ? -away * area[i] * pixels * inv * inv * inv : 0.0f;

    // The pixel, clamped to the border of the map.
    float u = fx * px * inv + cx, v = fy * py * inv + cy;
    u = u > 0.0f ? u : 0.0f;
    u = u < last_u ? u : last_u;
    v = v > 0.0f ? v : 0.0f;
    v = v < last_v ? v : last_v;
    out.pixel[i] = static_cast<std::int32_t>(v) * width + static_cast<std::int32_t>(u);

    out.x[i] = px;
    out.y[i] = py;
    out.z[i] = pz;
  }
}

/// Copies the cells of the block's pixels. One load per cell is faster than gathering its four members separately.
inline void look_up(const PixelMap& map, int n, Block& block) {
  const PixelMap::Cell* cells = map.cells.data();
  const std::int32_t* hidden = map.hidden.data();
  for (int i = 0; i < n; ++i) {
    block.cell[i] = cells[block.pixel[i]];
    block.hidden[i] = hidden[block.pixel[i]];
  }
}

/// Adds the block's distances; `bit` selects the segment in PixelMap::hidden.
inline void add_distances(const Block& block, int n, std::int32_t bit, float cap, PatchDistance& out) {
  float distance = 0, counted = 0, total = 0;
#pragma omp simd reduction(+ : distance, counted, total)
  for (int i = 0; i < n; ++i) {
    const PixelMap::Cell& cell = block.cell[i];
    // Compute the distance of the paper's Eq. 1: on hand pixels only the difference of depth counts.
    const float dx = block.x[i] - cell.x, dy = block.y[i] - cell.y, dz = block.z[i] - std::fabs(cell.z);
    const float lateral = cell.z < 0.0f ? dx * dx + dy * dy : 0.0f;
    float d = std::sqrt(lateral + dz * dz);
    d = d < cap ? d : cap;

    // Leave out hidden points.
    const bool seen = (block.z[i] <= cell.occluder_z) & ((block.hidden[i] & bit) == 0);
    const float seen_weight = seen ? block.weight[i] : 0.0f;
    distance += seen_weight * d;
    counted += seen_weight;
    total += block.weight[i];
  }

  out.distance += distance;
  out.counted += counted;
  out.total += total;
}

}  // namespace

BAREHAND_SIMD PatchDistance patch_distance(const SegmentSurface& skin, const SE3& T_camera_segment, int segment,
                                           const PixelMap& map, float cap) {
  const View view(T_camera_segment, map);
  const std::int32_t bit = std::int32_t{1} << segment;
  const int size = static_cast<int>(skin.size());
  PatchDistance sum;
  Block block;

  // Project the points block by block, look up their pixels, and add their distances.
  for (int begin = 0; begin < size; begin += kBlock) {
    const int n = std::min(kBlock, size - begin);
    project(skin, begin, n, view, block);
    look_up(map, n, block);
    add_distances(block, n, bit, cap, sum);
  }
  return sum;
}

}  // namespace barehand
