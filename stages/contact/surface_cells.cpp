#include "stages/contact/surface_cells.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

using Eigen::Vector3f;

constexpr float kSpacing = 0.0035f;    // size of a cell [m]
constexpr float kStep = 0.008f;        // largest difference in depth of neighbouring cells of one surface [m]
constexpr float kSurroundings = 0.2f;  // radius around the middle of the hand in which surfaces are observed [m]
constexpr float kCrease = 0.35f;       // normals that converge by more than this from cell to cell show a crease
constexpr int kWindow = 2;             // cells to each side that a surface is fitted to
constexpr float kFewest = 6;           // cells that a surface needs
constexpr float kFlat = 0.005f, kStraight = 0.05f;  // weights of the priors of no slope and no curvature, for each cell
constexpr std::int32_t kOther = -1, kSeed = -2;

/// Whether a point belongs to the forearm, which is not tracked: behind the wrist, within a cone that an arm reaches.
bool on_forearm(const SE3& T_palm_camera, const Eigen::Vector3d& p) {
  constexpr double kReach = 0.16, kSlant = 0.3, kWrist = 0.06, kHand = 0.015;
  const Eigen::Vector3d q = T_palm_camera * p;
  if (q.z() < -kHand || q.norm() > kReach) return false;
  return q.z() > kSlant * q.norm() || q.norm() < kWrist;
}

/// Whether another hand of the frame claims a pixel, given in coordinates of the frame.
bool of_other_hand(const HandObservations& observations, std::size_t own, int u, int v) {
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const HandObservation& other = *observations[k];
    if (k == own || !other.label.contains(u - other.u0, v - other.v0)) continue;
    if (other.label.at(u - other.u0, v - other.v0) == PixelLabel::hand) return true;
  }
  return false;
}

}  // namespace

void SurfaceCells::collect(const HandObservations& observations, const HandEstimates& estimates, std::size_t k,
                           const std::function<bool(const Vector3f&)>& on_skin, std::vector<SurfacePoint>& points,
                           std::vector<bool>& open) {
  const auto first = static_cast<std::int32_t>(open.size());
  fill_cells(observations, *estimates[k], k, on_skin);
  grow(open);

  // Add the cells of the new components to the points.
  for (std::size_t i = 0; i < component_.size(); ++i) {
    if (component_[i] < first) continue;
    SurfacePoint& point = points.emplace_back();
    point.p = fitted_[i];
    point.n = normal_[i];
    point.component = component_[i];
  }
}

/// The pixel that stands for a cell: of those that show an object the one with the middle depth, so that things thinner
/// than a cell are seen, too; the first one if none does.
std::array<int, 2> SurfaceCells::pixel_of(const HandObservation& seen, int c, int r) {
  const int u0 = c * step_, v0 = r * step_;
  block_.clear();
  for (int v = v0; v < v0 + step_; ++v)
    for (int u = u0; u < u0 + step_; ++u)
      if (seen.label.at(u, v) == PixelLabel::object && seen.depth.at(u, v) > 0)
        block_.emplace_back(seen.depth.at(u, v), std::array{u, v});
  if (block_.empty()) return {u0, v0};
  const auto middle = block_.begin() + static_cast<std::ptrdiff_t>(block_.size() / 2);
  std::nth_element(block_.begin(), middle, block_.end());
  return middle->second;
}

/// Copies the position of every cell that may belong to an object, and marks those that are labelled as object.
void SurfaceCells::fill_cells(const HandObservations& observations, const HandEstimate& estimate, std::size_t k,
                              const std::function<bool(const Vector3f&)>& on_skin) {
  const HandObservation& seen = *observations[k];
  const SE3 T_palm_camera = estimate.segments[kPalm].T_camera_segment.inverse();
  const Vector3f middle = estimate.segments[segment_of(2, 0)].T_camera_segment.t.cast<float>();
  const double z_palm = std::max(0.1, estimate.segments[kPalm].T_camera_segment.t.z());

  // Choose the spacing of the grid by the distance of the palm.
  step_ = std::max(1, static_cast<int>(std::lround(kSpacing * seen.frame->camera.fx / z_palm)));
  spacing_ = static_cast<float>(step_ / seen.frame->camera.fx);
  place_.reset(seen.depth.width() / step_, seen.depth.height() / step_, Vector3f::Zero());
  fitted_.reset(place_.width(), place_.height(), Vector3f::Zero());
  normal_.reset(place_.width(), place_.height(), Vector3f::Zero());
  component_.reset(place_.width(), place_.height(), kOther);
  beyond_.reset(place_.width(), place_.height(), 0);

  for (int r = 0; r < place_.height(); ++r)
    for (int c = 0; c < place_.width(); ++c) {
      const auto [u, v] = pixel_of(seen, c, r);
      const PixelLabel label = seen.label.at(u, v);
      if (label == PixelLabel::unknown) continue;
      const Vector3f p = seen.point(u, v);
      if (p.z() <= 0) continue;

      // Leave out the skin of this hand, the forearm and the other hand.
      const bool foreign = label == PixelLabel::hand && !on_skin(p);
      if (label == PixelLabel::hand && !foreign) continue;
      if (on_forearm(T_palm_camera, p.cast<double>())) continue;
      if (of_other_hand(observations, k, u + seen.u0, v + seen.v0)) continue;

      // Mark what lies beyond the surroundings of the hand.
      if ((p - middle).squaredNorm() > kSurroundings * kSurroundings) {
        beyond_.at(c, r) = std::abs(p.z() - middle.z()) < kSurroundings;
        continue;
      }

      // Keep the position; the component of an object grows from the cells that are labelled as object.
      place_.at(c, r) = p;
      if (label == PixelLabel::object || foreign) component_.at(c, r) = kSeed;
    }
}

/// Whether a cell has a surface. Fits it when it is asked for the first time: most cells are reached by no component.
bool SurfaceCells::has_surface(std::int32_t cell) {
  if (place_[cell].z() > 0 && fitted_[cell].z() == 0) fit(cell);
  return !normal_[cell].isZero();
}

/// Fits z = a + b x + c y + d x^2 + e x y + f y^2 to the cells around a cell, those of other surfaces left out. A plane
/// would lie within a ball in its middle and outside of it at its rim, where the window sees one side only.
void SurfaceCells::fit(std::int32_t cell) {
  const int c = cell % place_.width(), r = cell / place_.width();
  fitted_[cell] = place_[cell];

  // Add up the normal equations, in units of half the window's side from the centre.
  const Vector3f centre = place_[cell];
  const float unit = kWindow * spacing_ * centre.z();
  // Rows 0 to 5 become those of the matrix, row 6 the right-hand side; 8 rows are added fastest.
  Eigen::Matrix<float, 8, 6> sums = Eigen::Matrix<float, 8, 6>::Zero();
  Eigen::Matrix<float, 8, 1> row = Eigen::Matrix<float, 8, 1>::Zero();
  for (int y = std::max(0, r - kWindow); y <= std::min(place_.height() - 1, r + kWindow); ++y)
    for (int x = std::max(0, c - kWindow); x <= std::min(place_.width() - 1, c + kWindow); ++x) {
      const Vector3f& p = place_.at(x, y);
      if (p.z() <= 0 || std::abs(p.z() - centre.z()) > kStep * kWindow) continue;
      const Vector3f d = p - centre;
      const float u = d.x() / unit, v = d.y() / unit;
      row << 1, u, v, u * u, u * v, v * v, d.z(), 0;
      sums.noalias() += row * row.head<6>().transpose();
    }
  const float count = sums(0, 0);
  if (count < kFewest) return;

  // Solve, with weak priors: a narrow strip shows no slope across itself, and few cells show no curvature.
  Eigen::Matrix<float, 6, 6> A = sums.topRows<6>();
  A.diagonal().segment<2>(1).array() += kFlat * count;
  A.diagonal().tail<3>().array() += kStraight * count;
  const Eigen::Matrix<float, 6, 1> surface = A.llt().solve(sums.row(6).transpose());

  // State the point on the surface and the normal that faces the camera.
  fitted_[cell].z() += surface[0];
  normal_[cell] = Vector3f(surface[1] / unit, surface[2] / unit, -1).normalized();
  if (normal_[cell].dot(fitted_[cell]) > 0) normal_[cell] = -normal_[cell];
}

/// Numbers the connected surfaces that contain an object's cell. Surfaces end at steps in depth and at creases, where
/// one thing stands on another. A surface that reaches the border of the region continues there.
void SurfaceCells::grow(std::vector<bool>& open) {
  const int width = place_.width();

  // Two cells are joined unless there is a step or a concave crease between them.
  const auto joined = [&](std::int32_t i, std::int32_t j) {
    if (std::abs(place_[j].z() - place_[i].z()) > kStep || !has_surface(j)) return false;
    const Vector3f step = fitted_[j] - fitted_[i];
    return step.dot(normal_[i] - normal_[j]) < kCrease * step.norm();
  };

  // Begin a component at every seed that has none.
  for (std::int32_t seed = 0; seed < static_cast<std::int32_t>(component_.size()); ++seed) {
    if (component_[seed] != kSeed || !has_surface(seed)) continue;
    const auto number = static_cast<std::int32_t>(open.size());
    bool at_border = false;
    stack_.assign(1, seed);
    component_[seed] = number;

    // Visit all cells that are connected with it.
    while (!stack_.empty()) {
      const std::int32_t i = stack_.back();
      stack_.pop_back();
      const int c = i % width, r = i / width;
      for (const auto& [dc, dr] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        if (!place_.contains(c + dc, r + dr) || beyond_.at(c + dc, r + dr)) {
          at_border = true;
          continue;
        }

        // Join the neighbour if no crease and no step lies between.
        const auto j = static_cast<std::int32_t>(place_.index(c + dc, r + dr));
        if (component_[j] >= 0 || !joined(i, j)) continue;
        component_[j] = number;
        stack_.push_back(j);
      }
    }
    open.push_back(at_border);
  }
}

}  // namespace barehand
