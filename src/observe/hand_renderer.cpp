#include "observe/hand_renderer.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kNear = 0.05f;  // nothing is drawn closer to the camera [m]

void pose_normals(const Skin& skin, RenderedHand& out) {
  out.normal.assign(skin.vertices.size(), Vector3f::Zero());
  for (const auto& t : skin.triangles) {
    const Vector3f& p = out.position[t[0]];
    const Vector3f n = (out.position[t[1]] - p).cross(out.position[t[2]] - p);  // area-weighted
    for (int corner : t) out.normal[corner] += n;
  }
  for (Vector3f& n : out.normal) {
    const float norm = n.norm();
    if (norm > 0) n /= norm;
  }
}

class Rasteriser {
 public:
  Rasteriser(const Skin& skin, const Intrinsics& camera, RenderedHand& out) : skin_(skin), out_(out) {
    const CellGrid& g = out.grid;
    const float inverse_stride = 1.0f / g.stride;
    cell_.resize(out.position.size());
    for (std::size_t i = 0; i < cell_.size(); ++i) {
      const Vector3f& p = out.position[i];
      const float inverse_z = 1.0f / std::max(p.z(), kNear);
      cell_[i] = {
          (static_cast<float>(camera.fx) * p.x() * inverse_z + static_cast<float>(camera.cx) - g.u0) * inverse_stride,
          (static_cast<float>(camera.fy) * p.y() * inverse_z + static_cast<float>(camera.cy) - g.v0) * inverse_stride,
          inverse_z};
    }
  }

  void draw(const std::array<std::int32_t, 3>& t) {
    const Vector3f &a = cell_[t[0]], &b = cell_[t[1]], &c = cell_[t[2]];
    // Image v points down, so a triangle counter-clockwise from outside has negative area here when it faces us.
    const float area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (!(area < 0) || std::min({out_.position[t[0]].z(), out_.position[t[1]].z(), out_.position[t[2]].z()}) < kNear)
      return;
    const int i0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x(), b.x(), c.x()}))));
    const int i1 = std::min(out_.grid.width - 1, static_cast<int>(std::floor(std::max({a.x(), b.x(), c.x()}))));
    const int j0 = std::max(0, static_cast<int>(std::ceil(std::min({a.y(), b.y(), c.y()}))));
    const int j1 = std::min(out_.grid.height - 1, static_cast<int>(std::floor(std::max({a.y(), b.y(), c.y()}))));
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; i += kLanes) shade(t, 1.0f / area, i, std::min(i1, i + kLanes - 1), j);
  }

 private:
  // Cells i0 ... i1 of row j, at most kLanes of them. No branch depends on a cell: triangles are a few cells large, so
  // a processor would guess most of them wrong.
  void shade(const std::array<std::int32_t, 3>& t, float inverse_area, int i0, int i1, int j) {
    const Vector3f a = cell_[t[0]], b = cell_[t[1]], c = cell_[t[2]];
    // The last lanes of the picture: begin earlier rather than write beyond its end.
    const std::size_t begin = std::min(out_.depth.index(i0, j), out_.depth.size() - kLanes);
    const int first = i0 - static_cast<int>(out_.depth.index(i0, j) - begin);
    float* inverse_depth = out_.depth.data() + begin;
    std::int32_t* vertex = out_.vertex.data() + begin;
    const std::int32_t vertex_a = t[0], vertex_b = t[1], vertex_c = t[2];
    const float y = static_cast<float>(j);
    int covered_a = 0, covered_b = 0, covered_c = 0;
#pragma omp simd reduction(+ : covered_a, covered_b, covered_c)
    for (int k = 0; k < kLanes; ++k) {
      const float x = static_cast<float>(first + k);
      const float wa = ((b.x() - x) * (c.y() - y) - (b.y() - y) * (c.x() - x)) * inverse_area;
      const float wb = ((c.x() - x) * (a.y() - y) - (c.y() - y) * (a.x() - x)) * inverse_area;
      const float wc = 1 - wa - wb;
      const bool inside = (wa >= 0) & (wb >= 0) & (wc >= 0) & (first + k >= i0) & (first + k <= i1);
      const bool nearest_a = (wa >= wb) & (wa >= wc), nearest_b = !nearest_a & (wb >= wc);
      covered_a += inside & nearest_a;
      covered_b += inside & nearest_b;
      covered_c += inside & !nearest_a & !nearest_b;
      const float inverse_z = wa * a.z() + wb * b.z() + wc * c.z();  // 1/z is linear in the image
      const bool front = inside & (inverse_z > inverse_depth[k]);
      const std::int32_t carrier = nearest_a ? vertex_a : (nearest_b ? vertex_b : vertex_c);
      inverse_depth[k] = front ? inverse_z : inverse_depth[k];
      vertex[k] = front ? carrier : vertex[k];
    }
    out_.projected[skin_.vertices[t[0]].a] += covered_a;
    out_.projected[skin_.vertices[t[1]].a] += covered_b;
    out_.projected[skin_.vertices[t[2]].a] += covered_c;
  }

  static constexpr int kLanes = 8;
  const Skin& skin_;
  RenderedHand& out_;           // depth: its inverse while drawing, 0 where there is nothing yet
  std::vector<Vector3f> cell_;  // (i, j, 1/z) of every vertex
};

}  // namespace

void render_hand(const Skin& skin, const HandPose& pose, const Intrinsics& camera, const CellGrid& grid,
                 RenderedHand& out) {
  out.grid = grid;
  out.depth.reset(grid.width, grid.height, 0.0f);
  out.vertex.reset(grid.width, grid.height, -1);
  out.projected.fill(0);
  pose_skin(skin, pose, out.position);
  pose_normals(skin, out);
  Rasteriser rasteriser(skin, camera, out);
  for (const auto& t : skin.triangles) rasteriser.draw(t);
  for (std::size_t i = 0; i < out.depth.size(); ++i) out.depth[i] = out.depth[i] > 0 ? 1.0f / out.depth[i] : 0.0f;
}

}  // namespace barehand
