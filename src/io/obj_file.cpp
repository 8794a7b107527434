#include "io/obj_file.h"

#include <cmath>
#include <map>
#include <vector>

#include "core/format.h"
#include "io/atomic_file.h"

namespace barehand {

Result<void> save_obj(std::span<const Eigen::Vector3f> vertices,
                      std::span<const std::array<std::uint32_t, 3>> triangles, const std::string& path,
                      std::span<const ObjGroup> groups) {
  // Write every place once, with seven decimals (0.1 micrometres).
  constexpr double kStep = 1e-7;
  std::string text = "# metres\n";
  std::map<std::array<long long, 3>, std::size_t> known;
  std::vector<std::size_t> number;  // number of every vertex in the file, counted from 1
  for (const Eigen::Vector3f& v : vertices) {
    // Vertices at the same place share one line of the file.
    const std::array<long long, 3> steps = {std::llround(v.x() / kStep), std::llround(v.y() / kStep),
                                            std::llround(v.z() / kStep)};
    const auto [place, is_new] = known.emplace(steps, known.size() + 1);
    if (is_new)
      text += formatted("v %.7f %.7f %.7f\n", kStep * static_cast<double>(steps[0]),
                        kStep * static_cast<double>(steps[1]), kStep * static_cast<double>(steps[2]));
    number.push_back(place->second);
  }

  // Write the triangles.
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const ObjGroup& group : groups)
      if (group.first == i) text += formatted("g %s\n", group.name.c_str());

    // Leave out triangles that have collapsed to a line or a point.
    const auto& t = triangles[i];
    const std::size_t a = number[t[0]], b = number[t[1]], c = number[t[2]];
    if (a != b && b != c && c != a) text += formatted("f %zu %zu %zu\n", a, b, c);
  }
  return write_file_atomically(path, text);
}

}  // namespace barehand
