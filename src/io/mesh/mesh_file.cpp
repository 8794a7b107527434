// Reads the meshes of objects, by way of assimp.
#include "io/mesh/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>

#include "core/format.h"
#include "io/mesh/gltf_depth.h"

namespace barehand {
namespace {

/// A unit with its name and its length [m].
struct NamedUnit {
  LengthUnit unit;
  const char* name;
  double length;
};
constexpr std::array kUnits = {NamedUnit{LengthUnit::metre, "m", 1}, NamedUnit{LengthUnit::centimetre, "cm", 0.01},
                               NamedUnit{LengthUnit::millimetre, "mm", 0.001}};

const NamedUnit& named(LengthUnit unit) { return kUnits[static_cast<std::size_t>(unit)]; }

constexpr double kSmallest = 0.01, kLargest = 1.0;  // longest side of what a hand can hold and be tracked with [m]
constexpr double kUsualSmallest = 0.02, kUsualLargest = 0.5;  // longest side of most of these objects [m]
constexpr double kFarthest = 10;  // largest distance from the file's origin [m]: single precision is too coarse beyond
constexpr std::size_t kMostTriangles = 500'000;
constexpr int kDeepestJson = 100;  // most levels of nested JSON; assimp recurses at each and could overflow the stack

/// A length as text, in metres or millimetres.
std::string readable(double metres) {
  if (metres >= 1) return formatted("%.3g m", metres);
  return formatted("%.3g mm", 1000 * metres);
}

/// Whether a file begins like PLY but has no end of the header, for which assimp would search without end.
bool is_ply_without_end_of_header(const std::string& path) {
  constexpr std::size_t kLongestHeader = 1 << 16;
  std::ifstream file(path, std::ios::binary);
  std::string text(kLongestHeader, ' ');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  const bool ends = text.find("end_header\n") != std::string::npos || text.find("end_header\r") != std::string::npos;
  return text.starts_with("ply") && !ends;
}

/// Whether every face has corners, all of which are vertices of its mesh. Assimp relies on it, but does not check it.
bool has_sound_faces(const aiScene& scene) {
  const auto sound = [](const aiMesh& mesh, const aiFace& face) {
    const std::span corners(face.mIndices, face.mNumIndices);
    return !corners.empty() && std::ranges::all_of(corners, [&](unsigned v) { return v < mesh.mNumVertices; });
  };
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes))
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces))
      if (!sound(*mesh, face)) return false;
  return true;
}

/// Adds the triangles of one mesh of the file, without its lines and points.
void append(const aiMesh& part, double scale, ObjectMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D& p = part.mVertices[v];
    mesh.vertices.push_back((scale * Eigen::Vector3d(p.x, p.y, p.z)).cast<float>());
  }
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

/// Checks that the object has the size of something that a hand holds, and that it is near the origin of its file. If
/// the size is wrong, the error names the unit with which it would be right.
Result<void> check_size(const ObjectMesh& mesh, const std::string& path, LengthUnit unit) {
  // Measure the longest side.
  Eigen::Vector3f lower = mesh.vertices.front(), upper = lower;
  for (const auto& t : mesh.triangles)
    for (const auto v : t) {
      lower = lower.cwiseMin(mesh.vertices[v]);
      upper = upper.cwiseMax(mesh.vertices[v]);
    }

  // An object of a plausible size must also be near the origin of its file.
  const double size = (upper - lower).cast<double>().maxCoeff();
  const double away = (0.5f * (lower + upper)).cast<double>().norm();
  if (size >= kSmallest && size <= kLargest && away > kFarthest)
    return fail("the object is " + readable(away) + " away from the origin of the file", path,
                "move it to the origin with a modelling program");
  if (size >= kSmallest && size <= kLargest) return {};

  // Look for the unit that makes it an ordinary object.
  for (const NamedUnit& other : kUnits) {
    const double then = size / named(unit).length * other.length;
    if (then >= kUsualSmallest && then <= kUsualLargest)
      return fail("the object is " + readable(size) + " long if the file is in " + named(unit).name, path,
                  std::string("the file is probably in ") + other.name + ", which makes it " + readable(then) +
                      ": add --object-unit " + other.name);
  }
  return fail("the object is " + readable(size) + " long, which no hand can hold and no camera see in it", path,
              "scale it to between " + readable(kSmallest) + " and " + readable(kLargest));
}

}  // namespace

Result<LengthUnit> unit_from(const std::string& name) {
  for (const NamedUnit& unit : kUnits)
    if (name == unit.name) return unit.unit;
  return fail("\"" + name + "\" is no unit of length", "--object-unit", "give m, cm or mm");
}

Result<LoadedMesh> load_mesh(const std::string& path, LengthUnit unit) {
  // Check the file itself, since assimp does not explain these errors.
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    return fail(std::filesystem::exists(path, error) ? "is no file" : "there is no such file", path,
                "give the mesh of the object (OBJ, PLY, STL or glTF)");
  if (!std::ifstream(path)) return fail("cannot be read", path, "check its permissions");
  if (std::filesystem::file_size(path, error) == 0) return fail("is empty", path, "export the object's mesh again");

  // Reject files in which assimp would search without end or recurse too deeply.
  if (is_ply_without_end_of_header(path))
    return fail("is a PLY file whose header has no end", path, "export the object's mesh again");
  if (gltf_depth(path) > kDeepestJson)
    return fail(formatted("has more than %d levels of nested JSON", kDeepestJson), path,
                "export the object's mesh again");

  // Read the file, and place the parts of a scene by the transforms of its nodes.
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene && !has_sound_faces(*scene))
    return fail("has a face without corners, or with corners that the file does not hold", path,
                "it was probably cut short: export the object's mesh again");
  if (scene) scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (!scene)
    return fail(std::string("cannot be read as a mesh: ") + importer.GetErrorString(), path,
                "give an OBJ, PLY, STL or glTF file");

  // Join the meshes of the scene, in metres.
  LoadedMesh loaded;
  ObjectMesh& mesh = loaded.mesh;
  mesh.name = std::filesystem::path(path).stem().string();
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(*scene->mMeshes[i], named(unit).length, mesh);

  // Check the triangles and the vertices.
  if (mesh.triangles.empty())
    return fail("holds no triangles", path, "export the object's surface as triangles, not as points or lines");
  if (mesh.triangles.size() > kMostTriangles)
    return fail(formatted("has %zu triangles", mesh.triangles.size()), path,
                formatted("simplify it to %zu or fewer, 10,000 are plenty", kMostTriangles));
  for (const Eigen::Vector3f& v : mesh.vertices)
    if (!v.allFinite()) return fail("holds a vertex that is not finite", path, "export the object's mesh again");
  if (auto good = check_size(mesh, path, unit); !good) return tl::unexpected(good.error());

  // Make the mesh the closed surface of a solid.
  auto repair = repair_mesh(mesh, path);
  if (!repair) return tl::unexpected(repair.error());
  loaded.repair = *repair;
  return loaded;
}

}  // namespace barehand
