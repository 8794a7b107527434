#include "evaluation/object_evaluation.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "io/file_bytes.h"
#include "io/hand/table_fields.h"
#include "object/half_turns.h"
#include "object/known_object.h"

namespace barehand {
namespace {

/// The mean distance of a surface's samples, moved, from the surface [m].
double mean_distance(const MeshDistance& surface, const std::vector<SurfaceSample>& samples, const SE3& motion) {
  double sum = 0;
  for (const SurfaceSample& sample : samples) sum += surface.nearest(motion * sample.p.cast<double>()).distance;
  return sum / static_cast<double>(samples.size());
}

/// The angle between two orientations [rad].
double rotation_error(const SE3& a, const SE3& b) { return log_so3(a.R * b.R.transpose()).norm(); }

}  // namespace

Result<ObjectTruthTable> read_object_truth(const std::string& path) {
  // Read the file, and check that it is a table of object poses.
  auto content = read_text(path);
  if (!content) return tl::unexpected(content.error());
  std::istringstream file(std::move(*content));
  std::string line;
  std::getline(file, line);
  if (!line.starts_with("utime,object,held,x,y,z,qw,qx,qy,qz"))
    return fail("line 1 is not the header of a table of object poses", path,
                "it must begin with \"utime,object,held,x,y,z,qw,qx,qy,qz\"");

  // Read line by line.
  ObjectTruthTable table;
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    const auto fields = split_fields(line);
    std::int64_t utime = 0;
    std::array<double, 7> value{};

    // Check that the row holds finite numbers and a unit quaternion.
    bool good = fields.size() >= 10 && parse_number(fields[0], utime);
    for (std::size_t i = 0; good && i < value.size(); ++i)
      good = parse_number(fields[3 + i], value[i]) && std::isfinite(value[i]);
    const Eigen::Quaterniond q(value[3], value[4], value[5], value[6]);
    if (!good || std::abs(q.norm() - 1) > 1e-3)
      return fail("line " + std::to_string(number) + ": is \"" + line + "\"", path,
                  "a line is utime,object,held,x,y,z,qw,qx,qy,qz with a unit quaternion");

    // All rows are of one object.
    if (table.poses.empty()) table.name = fields[1];
    if (fields[1] != table.name)
      return fail("line " + std::to_string(number) + ": is of another object than line 2", path,
                  "give the table of one object");
    table.poses[utime] = {q.normalized().toRotationMatrix(), {value[0], value[1], value[2]}};
  }
  if (table.poses.empty()) return fail("holds no poses", path, "there is nothing to compare with");
  return table;
}

Result<ObjectEvaluation> evaluate_object(const ObjectTruthTable& truth, const ObjectPoses& stated,
                                         const ObjectMesh& mesh) {
  ObjectEvaluation out;
  out.name = truth.name;
  const std::vector<SurfaceSample> samples = sample_surface(mesh);
  const MeshDistance surface(mesh.vertices, mesh.triangles);

  // Find the symmetries.
  std::vector<SE3> same{SE3()};
  for (const SE3& turn : half_turns(mesh)) {
    const double moved = mean_distance(surface, samples, turn);
    if (moved >= kSameSurfaceTurned) continue;
    same.push_back(turn);
    out.symmetries.push_back(moved);
  }

  // Visit the frames of the truth; those without a stated pose are lost only after the first stated one.
  std::vector<double> position, rotation, apart;
  for (const auto& [utime, T_true] : truth.poses) {
    ++out.frames;
    const auto found = stated.find(utime);
    if (found == stated.end()) {
      out.lost += out.stated > 0;
      continue;
    }

    // Compare the poses that look like the stated one, and keep the errors of that with the least rotation.
    ++out.stated;
    const auto angle = [&](const SE3& turn) { return rotation_error(found->second * turn, T_true); };
    const SE3& turn = *std::ranges::min_element(same, {}, angle);
    out.turned += &turn != &same.front();
    position.push_back(((found->second * turn).t - T_true.t).norm());
    rotation.push_back(angle(turn));

    // Compare where the stated pose itself puts the surface.
    apart.push_back(mean_distance(surface, samples, T_true.inverse() * found->second));
  }

  // Poses of other times are those of another recording.
  if (out.stated == 0 && !stated.empty())
    return fail("no pose of object 1 is stated in a frame of the truth, but some are elsewhere", truth.name,
                "track the same recording with --object and this object's mesh");

  // Summarise the errors.
  out.position = summarise(std::move(position));
  out.rotation = summarise(std::move(rotation));
  out.surface = summarise(std::move(apart));
  return out;
}

}  // namespace barehand
