// Reads and writes the scanned skin in a hand profile's JSON.
#include "io/hand/skin_json.h"

#include <cmath>

#include "core/format.h"

namespace barehand {
namespace {

using json_fields::Json;

constexpr std::size_t kMostEntries = 200'000;
constexpr double kFarthestVertex = 0.5;  // largest distance of a vertex from the origin of its segment [m]

/// Rounds a coordinate to micrometres.
double micrometres(float metres) { return std::round(metres * 1e6) / 1e6; }

tl::unexpected<Error> bad(const std::string& where, const char* key, std::size_t i, const std::string& wanted) {
  return fail(formatted("\"%s\" %zu must be %s", key, i, wanted.c_str()), where,
              "scan the hand anew, or remove \"skin\": the skin then follows from the sections");
}

bool all_numbers(const Json& row) {
  for (const Json& value : row)
    if (!value.is_number()) return false;
  return true;
}

bool is_segment(double x) { return x >= 0 && x < kSegmentCount && x == std::floor(x); }

// Reads a vertex: [segment, x, y, z] or [segment, x, y, z, second segment, its weight, x, y, z]. Returns false if the
// row is invalid.
bool read_vertex(const Json& row, SkinVertex& v) {
  // Check the shape of the row.
  if (!row.is_array() || (row.size() != 4 && row.size() != 9) || !all_numbers(row)) return false;
  const auto number = [&](std::size_t i) { return row[i].get<double>(); };
  const auto point = [&](std::size_t i) { return Eigen::Vector3d(number(i), number(i + 1), number(i + 2)); };
  const auto near = [](const Eigen::Vector3d& p) { return p.norm() < kFarthestVertex; };  // NaN is never near

  // Read the first segment.
  if (!is_segment(number(0)) || !near(point(1))) return false;
  v.a = v.b = static_cast<std::int16_t>(number(0));
  v.in_a = v.in_b = point(1).cast<float>();
  v.normal_in_a.setZero();
  if (row.size() == 4) return true;

  // Read the second segment, which must be a neighbour of the first.
  if (!is_segment(number(4)) || !(number(5) > 0 && number(5) <= 0.5) || !near(point(6))) return false;
  v.b = static_cast<std::int16_t>(number(4));
  v.weight_b = static_cast<float>(number(5));
  v.in_b = point(6).cast<float>();
  return v.a != v.b && (parent_of(v.a) == v.b || parent_of(v.b) == v.a);
}

bool read_triangle(const Json& row, std::size_t vertices, std::array<std::int32_t, 3>& triangle) {
  if (!row.is_array() || row.size() != 3) return false;
  for (int k = 0; k < 3; ++k) {
    if (!row[k].is_number_unsigned() || row[k].get<std::uint64_t>() >= vertices) return false;
    triangle[k] = row[k].get<std::int32_t>();
  }
  return true;
}

Result<void> check_list(const Json& json, const char* key, const std::string& where) {
  if (!json.is_object() || !json.contains(key) || !json.at(key).is_array() || json.at(key).empty() ||
      json.at(key).size() > kMostEntries)
    return fail(formatted("\"%s\" is missing, empty, too long or not a list", key), where, "see docs/formats.md");
  return {};
}

}  // namespace

Result<Skin> skin_from_json(const Json& json, const std::string& where) {
  // Check that both lists are there.
  for (const char* key : {"vertices", "triangles"})
    if (const auto list = check_list(json, key, where); !list) return tl::unexpected(list.error());

  // Read the vertices.
  Skin skin;
  const Json &vertices = json.at("vertices"), &triangles = json.at("triangles");
  skin.vertices.resize(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!read_vertex(vertices[i], skin.vertices[i]))
      return bad(where, "vertices", i, "a place on one or two neighbouring segments");

  // Read the triangles, which refer to the vertices by their numbers.
  skin.triangles.resize(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (!read_triangle(triangles[i], vertices.size(), skin.triangles[i]))
      return bad(where, "triangles", i, "three vertices");
  return skin;
}

Json skin_to_json(const Skin& skin) {
  Json vertices = Json::array(), triangles = Json::array();
  for (const SkinVertex& v : skin.vertices) {
    Json row = {v.a, micrometres(v.in_a.x()), micrometres(v.in_a.y()), micrometres(v.in_a.z())};
    if (v.weight_b > 0)
      for (const Json& more : {Json(v.b), Json(v.weight_b), Json(micrometres(v.in_b.x())),
                               Json(micrometres(v.in_b.y())), Json(micrometres(v.in_b.z()))})
        row.push_back(more);
    vertices.push_back(std::move(row));
  }
  for (const auto& t : skin.triangles) triangles.push_back(t);
  return {{"vertices", std::move(vertices)}, {"triangles", std::move(triangles)}};
}

}  // namespace barehand
