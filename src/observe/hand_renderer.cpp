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
    const float inverse_area = 1.0f / area;
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        const float wa = ((b.x() - i) * (c.y() - j) - (b.y() - j) * (c.x() - i)) * inverse_area;
        const float wb = ((c.x() - i) * (a.y() - j) - (c.y() - j) * (a.x() - i)) * inverse_area;
        const float wc = 1 - wa - wb;
        if (wa < 0 || wb < 0 || wc < 0) continue;
        const int carrier = wa >= wb && wa >= wc ? t[0] : (wb >= wc ? t[1] : t[2]);
        shade(i, j, 1.0f / (wa * a.z() + wb * b.z() + wc * c.z()), carrier);  // 1/z is linear in the image
      }
    }
  }

 private:
  void shade(int i, int j, float z, int carrier) {
    ++out_.projected[skin_.vertices[carrier].a];
    float& depth = out_.depth.at(i, j);
    if (depth != 0 && depth <= z) return;
    depth = z;
    out_.vertex.at(i, j) = carrier;
  }

  const Skin& skin_;
  RenderedHand& out_;
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
}

}  // namespace barehand
