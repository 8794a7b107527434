#include "hand/surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace barehand {
namespace {

// Spreads points evenly over the tapered cylinders of the paper's hand model.

constexpr double kGoldenRatio = 0.6180339887498949;  // multiples of it modulo 1 fill [0, 1] evenly

/// The surface between two ellipses with the common axis directions e1 and e2: P(t, a) = c(t) + r1(t) cos(a) e1 +
/// r2(t) sin(a) e2.
struct Loft {
  std::array<Eigen::Vector3d, 2> centre;
  std::array<double, 2> r1, r2;
  Eigen::Vector3d e1, e2;

  static double mix(const std::array<double, 2>& v, double t) { return v[0] + t * (v[1] - v[0]); }
  Eigen::Vector3d point(double t, double a) const {
    return centre[0] + t * (centre[1] - centre[0]) + mix(r1, t) * std::cos(a) * e1 + mix(r2, t) * std::sin(a) * e2;
  }
  /// Outward normal; its length is the area per unit of t and a.
  Eigen::Vector3d normal_area(double t, double a) const {
    const Eigen::Vector3d along =
        centre[1] - centre[0] + (r1[1] - r1[0]) * std::cos(a) * e1 + (r2[1] - r2[0]) * std::sin(a) * e2;
    const Eigen::Vector3d around = -mix(r1, t) * std::sin(a) * e1 + mix(r2, t) * std::cos(a) * e2;
    return along.cross(around);
  }
};

/// Inverse of a cumulative distribution over equal cells of [0, 1], linear within each cell.
class InverseCdf {
 public:
  explicit InverseCdf(std::vector<double> mass) : cumulative_(std::move(mass)) {
    for (std::size_t i = 1; i < cumulative_.size(); ++i) cumulative_[i] += cumulative_[i - 1];
  }
  double total() const { return cumulative_.back(); }
  double operator()(double u) const {
    const double target = u * total();
    const auto it = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, target);
    const double below = it == cumulative_.begin() ? 0 : *(it - 1);
    return (static_cast<double>(it - cumulative_.begin()) + (target - below) / (*it - below)) / cumulative_.size();
  }

 private:
  std::vector<double> cumulative_;
};

/// Maps the unit square to a loft such that equal areas of the square become equal areas of the loft.
class LoftSampler {
 public:
  explicit LoftSampler(const Loft& loft) : loft_(loft) {
    for (int i = 0; i < kRows; ++i) {
      std::vector<double> mass(kColumns);
      for (int j = 0; j < kColumns; ++j)
        mass[j] = loft.normal_area((i + 0.5) / kRows, angle((j + 0.5) / kColumns)).norm();
      around_.emplace_back(std::move(mass));
    }
    std::vector<double> rows;
    for (const InverseCdf& row : around_) rows.push_back(row.total());
    along_.emplace_back(std::move(rows));
  }
  double area() const { return along_[0].total() * 2 * std::numbers::pi / (kRows * kColumns); }
  std::pair<Eigen::Vector3d, Eigen::Vector3d> point_and_normal(double u, double v) const {
    const double t = along_[0](u);
    const double a = angle(around_[std::min(static_cast<int>(t * kRows), kRows - 1)](v));
    return {loft_.point(t, a), loft_.normal_area(t, a).normalized()};
  }

 private:
  static constexpr int kRows = 64, kColumns = 64;
  static double angle(double v) { return 2 * std::numbers::pi * v; }

  Loft loft_;
  std::vector<InverseCdf> around_, along_;
};

// Appends one point.
void add_point(SegmentSurface& skin, const Eigen::Vector3d& p, const Eigen::Vector3d& n, double area) {
  skin.x.push_back(static_cast<float>(p.x()));
  skin.y.push_back(static_cast<float>(p.y()));
  skin.z.push_back(static_cast<float>(p.z()));
  skin.nx.push_back(static_cast<float>(n.x()));
  skin.ny.push_back(static_cast<float>(n.y()));
  skin.nz.push_back(static_cast<float>(n.z()));
  skin.area.push_back(static_cast<float>(area));
}

// Spreads points evenly over a loft.
void add_loft(SegmentSurface& skin, const LoftSampler& sampler, int points) {
  for (int i = 0; i < points; ++i) {
    const auto [p, n] = sampler.point_and_normal((i + 0.5) / points, std::fmod(i * kGoldenRatio, 1.0));
    add_point(skin, p, n, sampler.area() / points);
  }
}

/// Spreads points evenly over a hemisphere on the distal end; equal steps along its axis have equal areas
/// (Archimedes).
void add_cap(SegmentSurface& skin, const Loft& loft, const Eigen::Vector3d& axis, int points) {
  const double radius = loft.r1[1];
  for (int i = 0; i < points; ++i) {
    const double height = (i + 0.5) / points;
    const double ring = std::sqrt(1 - height * height);
    const double a = 2 * std::numbers::pi * std::fmod(i * kGoldenRatio, 1.0);
    const Eigen::Vector3d n = height * axis + ring * (std::cos(a) * loft.e1 + std::sin(a) * loft.e2);
    add_point(skin, loft.centre[1] + radius * n, n, 2 * std::numbers::pi * radius * radius / points);
  }
}

// The round, tapered skin of a phalanx.
Loft phalanx_loft(const SegmentProfile& s) {
  const Eigen::Vector3d axis = s.distal.normalized();
  const Eigen::Vector3d e1 = Eigen::Vector3d::UnitY().cross(-axis).normalized();
  return {{Eigen::Vector3d::Zero(), s.distal}, s.radius, s.radius, e1, e1.cross(axis)};
}

// The elliptic slab of the palm.
Loft palm_loft(const SegmentProfile& s) {
  const auto offset = [&](int end) { return Eigen::Vector3d(s.flesh_offset_x[end], s.flesh_offset_y[end], 0); };
  return {{offset(0), s.distal + offset(1)},
          s.half_width,
          s.half_thickness,
          Eigen::Vector3d::UnitX(),
          Eigen::Vector3d::UnitY()};
}

SegmentSurface segment_surface(const SegmentProfile& s, int segment, int points) {
  assert(s.distal.norm() > 0 && "a segment without length has no skin");
  const Loft loft = segment == kPalm ? palm_loft(s) : phalanx_loft(s);
  const LoftSampler sampler(loft);
  // Divide the points between the sides and a fingertip's cap in proportion to their areas.
  const double cap_area = is_tip(segment) ? 2 * std::numbers::pi * s.radius[1] * s.radius[1] : 0;
  const int cap_points = static_cast<int>(std::lround(points * cap_area / (cap_area + sampler.area())));
  SegmentSurface skin;
  add_loft(skin, sampler, points - cap_points);
  add_cap(skin, loft, s.distal.normalized(), cap_points);
  return skin;
}

}  // namespace

HandSurface make_cylinder_surface(const HandProfile& profile, int points_per_segment) {
  assert(points_per_segment > 0);
  HandSurface surface;
  for (int s = 0; s < kSegmentCount; ++s) surface[s] = segment_surface(profile.segments[s], s, points_per_segment);
  return surface;
}

}  // namespace barehand
