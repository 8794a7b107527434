#include "stages/refinement/skin_middle.h"

#include <Eigen/QR>
#include <cmath>

namespace barehand {

std::optional<SkinMiddle> skin_middle(const Skin& skin, int segment, double length) {
  constexpr float kAlong = 0.5f;  // cosine: skin that faces along the bone tells little
  constexpr int kUnknowns = 7, kFewest = 12;
  std::vector<int> members;
  for (int i = 0; i < static_cast<int>(skin.vertices.size()); ++i) {
    const SkinVertex& v = skin.vertices[i];
    if (v.a == segment && v.weight_b == 0 && std::abs(v.normal_in_a.z()) < kAlong) members.push_back(i);
  }
  const auto count = static_cast<Eigen::Index>(members.size());
  if (count < kFewest) return std::nullopt;
  // Least squares: n . p = n . middle(u) + radius(u) + e (n_x^2 - n_y^2), all across the bone; middle and radius are
  // linear in u, which goes from 0 at the joint to 1.
  Eigen::Matrix<double, Eigen::Dynamic, kUnknowns> A(count, kUnknowns);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SkinVertex& v = skin.vertices[members[k]];
    const double u = -v.in_a.z() / length, x = v.normal_in_a.x(), y = v.normal_in_a.y();
    A.row(k) << x, x * u, y, y * u, 1, u, x * x - y * y;
  }
  const Eigen::VectorXd weight = A.completeOrthogonalDecomposition().pseudoInverse().row(0);
  SkinMiddle middle;
  for (Eigen::Index k = 0; k < count; ++k) {
    const SkinVertex& v = skin.vertices[members[k]];
    const Eigen::Vector2d normal = v.normal_in_a.head<2>().cast<double>();
    middle.x += weight[k] * normal.dot(v.in_a.head<2>().cast<double>());
    middle.per_offset.emplace_back(members[k], weight[k] * normal.squaredNorm());
  }
  return middle;
}

}  // namespace barehand
