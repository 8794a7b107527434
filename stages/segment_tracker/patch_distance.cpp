#include "stages/segment_tracker/patch_distance.h"

#include <cmath>

namespace barehand {
namespace {

constexpr float kNearest = 0.01f;  // skin nearer to the camera than this [m] is not seen by any depth sensor

}  // namespace

PatchDistance patch_distance(const SegmentSurface& skin, const SE3& T_camera_segment, int segment, const PixelMap& map,
                             float cap) {
  const Eigen::Matrix3f R = T_camera_segment.R.cast<float>();
  const Eigen::Vector3f t = T_camera_segment.t.cast<float>();
  const float r00 = R(0, 0), r01 = R(0, 1), r02 = R(0, 2), r10 = R(1, 0), r11 = R(1, 1), r12 = R(1, 2);
  const float r20 = R(2, 0), r21 = R(2, 1), r22 = R(2, 2), tx = t[0], ty = t[1], tz = t[2];
  // n.p is needed in camera coordinates only as a scalar: n_camera . p_camera = n . (p + R^T t).
  const Eigen::Vector3f origin = R.transpose() * t;
  const float ox = origin[0], oy = origin[1], oz = origin[2];
  const float *x = skin.x.data(), *y = skin.y.data(), *z = skin.z.data();
  const float *nx = skin.nx.data(), *ny = skin.ny.data(), *nz = skin.nz.data(), *area = skin.area.data();
  const PixelMap::Cell* cells = map.cells.data();
  const std::int32_t* hidden = map.hidden.data();
  const float fx = map.fx, fy = map.fy, pixels = fx * fy, cx = map.cx + 0.5f, cy = map.cy + 0.5f;
  const float last_u = static_cast<float>(map.width - 1), last_v = static_cast<float>(map.height - 1);
  const std::int32_t width = map.width, bit = std::int32_t{1} << segment, n = static_cast<std::int32_t>(skin.size());

  float distance = 0, counted = 0, total = 0;
#pragma omp simd reduction(+ : distance, counted, total)
  for (std::int32_t i = 0; i < n; ++i) {
    const float px = r00 * x[i] + r01 * y[i] + r02 * z[i] + tx;
    const float py = r10 * x[i] + r11 * y[i] + r12 * z[i] + ty;
    const float pz = r20 * x[i] + r21 * y[i] + r22 * z[i] + tz;
    const float away = nx[i] * (x[i] + ox) + ny[i] * (y[i] + oy) + nz[i] * (z[i] + oz);
    const float inv = 1.0f / (pz > kNearest ? pz : kNearest);
    // Solid angle on the image plane: a patch covers f^2 area (-n.p) / z^3 pixels.
    const bool front = (away < 0.0f) & (pz > kNearest);
    const float weight = front ? -away * area[i] * pixels * inv * inv * inv : 0.0f;

    float u = fx * px * inv + cx, v = fy * py * inv + cy;  // truncation rounds to the nearest pixel
    u = u > 0.0f ? u : 0.0f;
    u = u < last_u ? u : last_u;
    v = v > 0.0f ? v : 0.0f;
    v = v < last_v ? v : last_v;
    const std::int32_t k = static_cast<std::int32_t>(v) * width + static_cast<std::int32_t>(u);
    const PixelMap::Cell& cell = cells[k];
    const float cell_z = cell.z;

    // Eq. 1; on hand pixels the depth difference alone.
    const float dx = px - cell.x, dy = py - cell.y, dz = pz - std::fabs(cell_z);
    const float lateral = cell_z < 0.0f ? dx * dx + dy * dy : 0.0f;
    float d = std::sqrt(lateral + dz * dz);
    d = d < cap ? d : cap;
    const bool seen = (pz <= cell.occluder_z) & ((hidden[k] & bit) == 0);
    const float seen_weight = seen ? weight : 0.0f;
    distance += seen_weight * d;
    counted += seen_weight;
    total += weight;
  }
  return {distance, counted, total};
}

}  // namespace barehand
