// Makes the mesh of an object closed, or says why it cannot be.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "core/format.h"
#include "object/object_mesh.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Index = std::uint32_t;
using Triangle = MeshDistance::Triangle;
using Edge = std::pair<Index, Index>;

constexpr float kSamePlace = 1e-5f;    // vertices this near to each other are one, as a fraction of the object's size
constexpr double kSmallHole = 0.25;    // holes up to this width are closed, as a fraction of the object's size
constexpr double kLeastVolume = 1e-6;  // smallest volume of a solid, as a fraction of the cube around it
constexpr const char* kRemedy =
    "close the mesh with a modelling program, for example Blender (3D-Print Toolbox) or MeshLab (Close Holes)";

float size_of(const ObjectMesh& mesh) { return bounding_box(mesh).sizes().maxCoeff(); }

/// Leaves out the vertices that belong to no triangle: they would count as a part of the object's size.
void remove_unused(ObjectMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const Index corner : t) used[corner] = true;
  std::vector<Vector3f> kept;
  std::vector<Index> index(mesh.vertices.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    index[i] = static_cast<Index>(kept.size());
    if (used[i]) kept.push_back(mesh.vertices[i]);
  }
  mesh.vertices = std::move(kept);
  for (Triangle& t : mesh.triangles)
    for (Index& corner : t) corner = index[corner];
}

/// Merges vertices at the same place, as files have them where a surface has an edge or a seam.
void merge_vertices(ObjectMesh& mesh, MeshRepair& repair) {
  // Sort the vertices into cells so large that the same place is found in a cell or in its neighbours.
  const float tolerance = kSamePlace * size_of(mesh), cell = 4 * tolerance;
  std::map<std::tuple<int, int, int>, std::vector<Index>> cells;
  std::vector<Vector3f> kept;
  std::vector<Index> index(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3f& v = mesh.vertices[i];
    const Eigen::Vector3i lower = ((v.array() - tolerance) / cell).floor().cast<int>();
    const Eigen::Vector3i upper = ((v.array() + tolerance) / cell).floor().cast<int>();

    // Find the first kept vertex at this place.
    Index found = static_cast<Index>(kept.size());
    for (int x = lower.x(); x <= upper.x(); ++x)
      for (int y = lower.y(); y <= upper.y(); ++y)
        for (int z = lower.z(); z <= upper.z(); ++z) {
          const auto at = cells.find({x, y, z});
          if (at == cells.end()) continue;
          for (const Index k : at->second)
            if ((kept[k] - v).norm() <= tolerance) found = std::min(found, k);
        }
    index[i] = found;
    if (found < kept.size()) continue;

    // Otherwise keep the vertex at its new place.
    const Eigen::Vector3i own = (v / cell).array().floor().cast<int>();
    cells[{own.x(), own.y(), own.z()}].push_back(found);
    kept.push_back(v);
  }

  // Renumber the triangles.
  repair.merged = mesh.vertices.size() - kept.size();
  mesh.vertices = std::move(kept);
  for (Triangle& t : mesh.triangles)
    for (Index& corner : t) corner = index[corner];
}

void remove_degenerate(ObjectMesh& mesh, MeshRepair& repair) {
  std::map<Triangle, bool> known;
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
    Triangle sorted = t;
    std::sort(sorted.begin(), sorted.end());
    return !known.emplace(sorted, true).second;
  });
  repair.removed = before - mesh.triangles.size();
}

/// The triangles at every edge, in both directions: (from, to) of the smaller to the larger vertex, and whether the
/// triangle runs that way.
std::map<Edge, std::vector<std::pair<Index, bool>>> triangles_by_edge(const ObjectMesh& mesh) {
  std::map<Edge, std::vector<std::pair<Index, bool>>> edges;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
      edges[std::minmax(a, b)].emplace_back(static_cast<Index>(i), a < b);
    }
  return edges;
}

double volume(const ObjectMesh& mesh, const std::vector<Index>& triangles) {
  double sum = 0;
  for (const Index i : triangles) {
    const auto corner = [&](int k) -> Vector3d { return mesh.vertices[mesh.triangles[i][k]].cast<double>(); };
    sum += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  return sum;
}

/// Turns neighbouring triangles the same way round. Returns the connected parts; error: the surface has one side only.
Result<std::vector<std::vector<Index>>> orient(ObjectMesh& mesh, const std::string& where, MeshRepair& repair) {
  // List the neighbours, and whether they run the same way round.
  std::vector<std::vector<std::pair<Index, bool>>> neighbours(mesh.triangles.size());
  for (const auto& [edge, at] : triangles_by_edge(mesh)) {
    if (at.size() != 2) continue;
    const bool consistent = at[0].second != at[1].second;
    neighbours[at[0].first].emplace_back(at[1].first, consistent);
    neighbours[at[1].first].emplace_back(at[0].first, consistent);
  }

  // Visit the triangles part by part.
  enum : char { unvisited, as_it_is, turned };
  std::vector<char> state(mesh.triangles.size(), unvisited);
  std::vector<std::vector<Index>> parts;
  for (std::size_t first = 0; first < state.size(); ++first) {
    if (state[first] != unvisited) continue;
    std::vector<Index>& part = parts.emplace_back(1, static_cast<Index>(first));
    state[first] = as_it_is;

    // Turn each neighbour that runs the other way round, which must not contradict an earlier decision.
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const auto& [other, consistent] : neighbours[part[i]]) {
        const char wanted = (state[part[i]] == as_it_is) == consistent ? as_it_is : turned;
        if (state[other] == unvisited)
          part.push_back(other), state[other] = wanted;
        else if (state[other] != wanted)
          return fail("the surface has one side only, like a Moebius strip", where, kRemedy);
      }
  }

  // Turn the triangles.
  for (std::size_t i = 0; i < state.size(); ++i)
    if (state[i] == turned) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]), ++repair.flipped;
  return parts;
}

/// Turns the parts outwards. A file whose triangles run consistently has cavities that face inwards on purpose.
void turn_outwards(ObjectMesh& mesh, const std::vector<std::vector<Index>>& parts, MeshRepair& repair) {
  double all = 0;
  for (const auto& part : parts) all += volume(mesh, part);
  for (const auto& part : parts) {
    const bool inwards = repair.flipped > 0 ? volume(mesh, part) < 0 : all < 0;
    if (!inwards) continue;
    for (const Index i : part) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]), ++repair.flipped;
  }
}

/// Closes the hole that a loop of boundary edges surrounds by a fan around its middle.
Result<void> close_hole(ObjectMesh& mesh, const std::vector<Index>& loop, double size, const std::string& where) {
  Vector3f middle = Vector3f::Zero();
  for (const Index v : loop) middle += mesh.vertices[v] / static_cast<float>(loop.size());
  double width = 0;
  for (const Index v : loop) width = std::max(width, 2.0 * (mesh.vertices[v] - middle).norm());
  if (width > kSmallHole * size)
    return fail(formatted("the surface is not closed: it has an opening %.1f mm wide", 1000 * width), where, kRemedy);
  const auto centre = static_cast<Index>(mesh.vertices.size());
  mesh.vertices.push_back(middle);
  for (std::size_t i = 0; i < loop.size(); ++i)
    mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], centre});
  return {};
}

/// Closes small holes. Error: a wide one, or an edge with an odd number of triangles.
Result<void> close_holes(ObjectMesh& mesh, const std::string& where, MeshRepair& repair) {
  // Collect the edges with one triangle, in the direction of that triangle.
  const double size = size_of(mesh);
  std::multimap<Index, Index> open;
  for (const auto& [edge, at] : triangles_by_edge(mesh)) {
    if (at.size() % 2 == 0) continue;
    if (at.size() > 1)
      return fail(formatted("%zu triangles meet at one edge: the surface branches there", at.size()), where, kRemedy);
    open.insert(at[0].second ? edge : Edge(edge.second, edge.first));
  }

  // Follow them around each hole.
  while (!open.empty()) {
    std::vector<Index> loop{open.begin()->first};
    for (auto at = open.begin(); at != open.end(); at = open.find(loop.back())) {
      const Index next = at->second;
      open.erase(at);
      if (next == loop.front()) break;
      loop.push_back(next);
    }

    // Close the hole along the loop.
    if (auto closed = close_hole(mesh, loop, size, where); !closed) return closed;
    ++repair.closed;
  }
  return {};
}

}  // namespace

Eigen::AlignedBox3f bounding_box(const ObjectMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Vector3f& v : mesh.vertices) box.extend(v);
  return box;
}

Result<MeshRepair> repair_mesh(ObjectMesh& mesh, const std::string& where) {
  // Merge vertices at the same place, and remove triangles without area and duplicates.
  MeshRepair repair;
  if (mesh.triangles.empty()) return fail("holds no triangles", where, "export the object's surface as triangles");
  remove_unused(mesh);
  merge_vertices(mesh, repair);
  remove_degenerate(mesh, repair);
  if (mesh.triangles.empty()) return fail("holds no triangle that has an area", where, kRemedy);
  remove_unused(mesh);

  // Turn the triangles, and close the holes.
  const auto parts = orient(mesh, where, repair);
  if (!parts) return tl::unexpected(parts.error());
  turn_outwards(mesh, *parts, repair);
  if (auto closed = close_holes(mesh, where, repair); !closed) return tl::unexpected(closed.error());

  // A sheet with two sides is closed, but encloses nothing.
  std::vector<Index> all(mesh.triangles.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
  const double size = size_of(mesh);
  if (volume(mesh, all) < kLeastVolume * size * size * size)
    return fail("the surface encloses no volume", where, "give the sheet the thickness that it has");
  return repair;
}

}  // namespace barehand
