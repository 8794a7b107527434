// Fits the cross-sections of a segment to its skin.
#include "person/skin_sections.h"

#include <Eigen/QR>
#include <cmath>

namespace barehand {

std::optional<SkinSections> SkinSections::fit(const Skin& skin, int segment, double length, bool alone) {
  constexpr float kAlong = 0.5f;  // cosine; skin that faces along the bone hardly depends on the section

  // Fewer vertices than this do not determine a section.
  constexpr std::size_t kFewest = 12;

  // Select the skin on the sides of the bone.
  SkinSections sections;
  for (int i = 0; i < static_cast<int>(skin.vertices.size()); ++i) {
    const SkinVertex& v = skin.vertices[i];
    if (v.a != segment || (alone && v.weight_b > 0) || std::abs(v.normal_in_a.z()) >= kAlong) continue;
    sections.vertices_.push_back(i);
  }

  if (sections.vertices_.size() < kFewest) return std::nullopt;

  // Set up the linearised support function of an ellipse: n . p = n . middle(u) + radius(u) + e (n_x^2 - n_y^2).
  const auto count = static_cast<Eigen::Index>(sections.vertices_.size());
  Eigen::Matrix<double, Eigen::Dynamic, 7> A(count, 7);
  Eigen::VectorXd support(count), squares(count);

  // Add one equation for each vertex.
  for (Eigen::Index k = 0; k < count; ++k) {
    const SkinVertex& v = skin.vertices[sections.vertices_[k]];
    const Eigen::Vector2d n = v.normal_in_a.head<2>().cast<double>(), p = v.in_a.head<2>().cast<double>();
    const double u = -v.in_a.z() / length;
    A.row(k) << n.x(), n.x() * u, n.y(), n.y() * u, 1, u, n.x() * n.x() - n.y() * n.y();
    support[k] = n.dot(p);
    squares[k] = n.squaredNorm();
  }

  // Solve. The pseudo-inverse also yields the derivative with respect to each vertex's offset.
  const Eigen::MatrixXd inverse = A.completeOrthogonalDecomposition().pseudoInverse();
  sections.fit_ = inverse * support;
  sections.per_offset_ = inverse.row(0).transpose().cwiseProduct(squares);
  return sections;
}

}  // namespace barehand
