#include "hand/rendering/hand_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace barehand {
namespace {

// A software rasteriser for the skin, which draws several cells at once with SIMD.

using Eigen::Vector2f;
using Eigen::Vector3f;

using Triangle = std::array<std::int32_t, 3>;

// The renderer draws this many neighbouring cells of a row at once. (The compiler's vector type works at any width on
// every processor.)
constexpr int kLanes = 8;
using Lanes = float __attribute__((vector_size(4 * kLanes)));
using IntLanes = std::int32_t __attribute__((vector_size(4 * kLanes)));
constexpr Lanes kSteps{0, 1, 2, 3, 4, 5, 6, 7};

constexpr float kNear = 0.05f;  // triangles closer to the camera are not drawn [m]

/// Vertex normals as the area-weighted mean of the normals of the triangles around each vertex.
void pose_normals(const Skin& skin, RenderedHand& out) {
  out.normal.assign(skin.vertices.size(), Vector3f::Zero());
  for (const auto& t : skin.triangles) {
    const Vector3f& p = out.position[t[0]];
    const Vector3f n = (out.position[t[1]] - p).cross(out.position[t[2]] - p);  // its length is twice the area
    for (int corner : t) out.normal[corner] += n;
  }
  for (Vector3f& n : out.normal) {
    const float norm = n.norm();
    if (norm > 0) n /= norm;
  }
}

/// Draws triangles into the z-buffer of a RenderedHand.
class Rasteriser {
  using Vertex = Eigen::Array4f;  // (i, j, 1/z, z)

 public:
  Rasteriser(const Skin& skin, const Intrinsics& camera, RenderedHand& out) : skin_(skin), out_(out) {
    const CellGrid& g = out.grid;
    const float inverse_stride = 1.0f / g.stride;
    first_ = {-g.u0 * inverse_stride, -g.v0 * inverse_stride};
    last_ = {(camera.width - 1 - g.u0) * inverse_stride, (camera.height - 1 - g.v0) * inverse_stride};
    out.in_grid.resize(out.position.size());
    for (std::size_t i = 0; i < out.in_grid.size(); ++i) {
      const Vector3f& p = out.position[i];
      const float inverse_z = 1.0f / std::max(p.z(), kNear);
      out.in_grid[i] = {
          (static_cast<float>(camera.fx) * p.x() * inverse_z + static_cast<float>(camera.cx) - g.u0) * inverse_stride,
          (static_cast<float>(camera.fy) * p.y() * inverse_z + static_cast<float>(camera.cy) - g.v0) * inverse_stride,
          inverse_z, p.z()};
    }
  }

  // Draws one triangle if it faces the camera.
  void draw(const Triangle& t) {
    const Vertex &a = out_.in_grid[t[0]], &b = out_.in_grid[t[1]], &c = out_.in_grid[t[2]];
    // The image's v axis points down, so a triangle that is counter-clockwise from outside has a negative area here
    // when it faces the camera.
    const float area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    const Vertex low = a.min(b).min(c), high = a.max(b).max(c);
    if (!(area < 0) || low.w() < kNear) return;

    // Note its area if it lies beyond the border of the image.
    const Eigen::Array2f centre = (a + b + c).head<2>() / 3;
    if ((centre < first_).any() || (centre > last_).any()) out_.beyond[skin_.vertices[t[0]].a] -= area / 2;

    // Draw the cells within the triangle's bounding box, one strip of columns after the other.
    const Eigen::Array4i first = low.ceil().cast<int>(), last = high.floor().cast<int>();
    const Box box{std::max(0, first.x()), std::min(out_.grid.width - 1, last.x()), std::max(0, first.y()),
                  std::min(out_.grid.height - 1, last.y())};
    for (int i = box.i0; i <= box.i1; i += kLanes) shade(t, 1.0f / area, box, i);
  }

 private:
  // First and last column (i) and row (j) of a triangle's bounding box.
  struct Box {
    int i0, i1, j0, j1;
  };

  // Draws the kLanes columns from `i` on in all rows of the box. No branch depends on a cell: triangles cover only a
  // few cells, so most of such branches would be mispredicted.
  void shade(const Triangle& t, float inverse_area, const Box& box, int i) {
    const Vertex &a = out_.in_grid[t[0]], &b = out_.in_grid[t[1]], &c = out_.in_grid[t[2]];

    // Barycentric weights and 1/z are linear in the image, so going down a row adds a constant.
    const Lanes x = static_cast<float>(i) + kSteps;
    const float y = static_cast<float>(box.j0);
    Lanes wa = ((b.x() - x) * (c.y() - y) - (b.y() - y) * (c.x() - x)) * inverse_area;
    Lanes wb = ((c.x() - x) * (a.y() - y) - (c.y() - y) * (a.x() - x)) * inverse_area;
    const float wa_down = (c.x() - b.x()) * inverse_area, wb_down = (a.x() - c.x()) * inverse_area;
    const IntLanes columns = x <= static_cast<float>(box.i1);

    // Assign every covered cell to the vertex with the largest barycentric weight. (A true lane is -1, hence the
    // subtraction.)
    IntLanes covered_a{}, covered_b{}, covered_c{};
    for (int j = box.j0; j <= box.j1; ++j, wa += wa_down, wb += wb_down) {
      const Lanes wc = 1.0f - wa - wb;
      const IntLanes inside = columns & (wa >= 0.0f) & (wb >= 0.0f) & (wc >= 0.0f);
      const IntLanes nearest_a = (wa >= wb) & (wa >= wc), nearest_b = ~nearest_a & (wb >= wc);
      covered_a -= inside & nearest_a;
      covered_b -= inside & nearest_b;
      covered_c -= inside & ~nearest_a & ~nearest_b;

      // Draw the inverse depth of each cell, and the vertex with the largest barycentric weight.
      const Lanes inverse_z = wa * a.z() + wb * b.z() + wc * c.z();
      const IntLanes carrier = nearest_a ? IntLanes{} + t[0] : (nearest_b ? IntLanes{} + t[1] : IntLanes{} + t[2]);
      put(i, j, inside, inverse_z, carrier);
    }

    // Add the covered cells to the count of each vertex's segment.
    const int segment_a = skin_.vertices[t[0]].a, segment_b = skin_.vertices[t[1]].a,
              segment_c = skin_.vertices[t[2]].a;
    if (segment_a == segment_b && segment_b == segment_c) {  // the case of nearly all triangles
      out_.projected[segment_a] += sum(covered_a + covered_b + covered_c);
      return;
    }
    out_.projected[segment_a] += sum(covered_a);
    out_.projected[segment_b] += sum(covered_b);
    out_.projected[segment_c] += sum(covered_c);
  }

  // Sum of all lanes.
  static int sum(const IntLanes& lanes) {
    using Half = std::int32_t __attribute__((vector_size(2 * kLanes)));
    std::array<Half, 2> halves;
    std::memcpy(&halves, &lanes, sizeof lanes);
    const Half two = halves[0] + halves[1];
    return (two[0] + two[1]) + (two[2] + two[3]);
  }

  // Writes one row of lanes where they are inside the triangle and in front of what was drawn before.
  void put(int i, int j, const IntLanes& inside, const Lanes& inverse_z, const IntLanes& carrier) {
    float* depth = &out_.depth.at(i, j);
    std::int32_t* vertex = &out_.vertex.at(i, j);

    // Lanes beyond the end of the row belong to the next row, and `inside` leaves them as they are. The last row has
    // no next one, so only the bytes that are left may be touched.
    const std::size_t left = out_.depth.size() - out_.depth.index(i, j);
    const std::size_t bytes = sizeof(float) * std::min<std::size_t>(left, kLanes);
    Lanes old_depth{};
    IntLanes old_vertex{};

    // Load the old cells, replace those that are now hidden, and store them.
    const auto blend = [&](std::size_t size) {
      std::memcpy(&old_depth, depth, size);
      std::memcpy(&old_vertex, vertex, size);
      const IntLanes front = inside & (inverse_z > old_depth);
      old_depth = front ? inverse_z : old_depth;
      old_vertex = front ? carrier : old_vertex;
      std::memcpy(depth, &old_depth, size);
      std::memcpy(vertex, &old_vertex, size);
    };

    // Access only the bytes that are left in the image.
    bytes == sizeof(Lanes) ? blend(sizeof(Lanes)) : blend(bytes);  // a constant size compiles to a single instruction
  }

  const Skin& skin_;
  Eigen::Array2f first_, last_;  // first and last pixel of the image, in cells of the grid
  RenderedHand& out_;            // depth holds 1/z while drawing; 0 where nothing was drawn yet
};

}  // namespace

void render_hand(const Skin& skin, const HandPose& pose, const Intrinsics& camera, const CellGrid& grid,
                 RenderedHand& out, Normals normals) {
  // Reset the buffers.
  out.grid = grid;
  out.depth.reset(grid.width, grid.height, 0.0f);
  out.vertex.reset(grid.width, grid.height, -1);
  out.projected.fill(0);
  out.beyond.fill(0);

  // Pose the skin.
  pose_skin(skin, pose, out.position);
  out.normal.clear();
  if (normals == Normals::computed) pose_normals(skin, out);

  // Draw all triangles, then turn the inverse depth into depth.
  Rasteriser rasteriser(skin, camera, out);
  for (const auto& t : skin.triangles) rasteriser.draw(t);
  for (int s = 0; s < kSegmentCount; ++s) out.projected[s] += static_cast<int>(std::lround(out.beyond[s]));
  for (std::size_t i = 0; i < out.depth.size(); ++i) out.depth[i] = out.depth[i] > 0 ? 1.0f / out.depth[i] : 0.0f;
}

}  // namespace barehand
