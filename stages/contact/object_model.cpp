#include "stages/contact/object_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace barehand {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;
using Eigen::Vector3i;

constexpr int kSide = 64;          // cells along each side of the grid, whose middle is the object's origin
constexpr float kCell = 0.004f;    // [m]
constexpr int kReach = 2;          // cells to each side in which a point's surfel is searched
constexpr float kMostSeen = 20;    // weight up to which a surfel is averaged
constexpr float kBlank = 1;        // weight that a surfel loses if it should be visible but no depth is measured there
constexpr float kTrusted = 2;      // weight of a surfel that counts as known
constexpr int kTrustedEmpty = 3;   // number of frames that must see a cell empty before it counts as empty
constexpr float kAround = 0.024f;  // how far around the surface empty cells are remembered [m]
constexpr std::size_t kMostSurfels = 8000;
constexpr int kMostCells = 20'000;  // number of cells that are tested for emptiness in one frame
constexpr int kIterations = 4, kMostPoints = 250;
constexpr double kOutlier = 0.005;  // distance to a surfel's plane at which a point has lost most of its weight [m]
constexpr double kPointDeviation = 0.0015, kIndependent = 20;     // deviation of a point [m]; how many are independent
constexpr double kPredictedShift = 0.003, kPredictedTurn = 0.05;  // deviations of the predicted pose [m, rad]

/// A pose in single precision.
struct Pose {
  explicit Pose(const SE3& T) : R(T.R.cast<float>()), t(T.t.cast<float>()) {}
  Vector3f operator*(const Vector3f& p) const { return R * p + t; }
  Vector3f back(const Vector3f& p) const { return R.transpose() * (p - t); }
  Matrix3f R;
  Vector3f t;
};

/// Whether the camera is on the outer side of a surfel.
template <class Surfel>
bool faces_camera(const Pose& T, const Surfel& surfel) {
  return (T * surfel.p).dot(T.R * surfel.n) < 0;
}

Vector3i indices(const Vector3f& p) { return ((p / kCell).array() + kSide / 2).floor().cast<int>(); }
bool inside(const Vector3i& i) { return (i.array() >= 0).all() && (i.array() < kSide).all(); }
std::int32_t number(const Vector3i& i) { return (i.z() * kSide + i.y()) * kSide + i.x(); }

}  // namespace

std::int32_t ObjectModel::cell_of(const Vector3f& p) const {
  const Vector3i i = indices(p);
  return cells_.empty() || !inside(i) ? -1 : number(i);
}

/// The nearest surfel in the cells around a place; -1: none.
int ObjectModel::nearest(const Vector3f& p) const {
  if (!near(p)) return -1;
  const Vector3i i = indices(p);
  if ((i.array() < kReach).any() || (i.array() >= kSide - kReach).any()) return -1;

  // Compare the surfels of all cells within reach.
  int best = -1;
  float least = std::numeric_limits<float>::infinity();
  for (int z = -kReach; z <= kReach; ++z)
    for (int y = -kReach; y <= kReach; ++y) {
      const Cell* row = &cells_[number(i + Vector3i(-kReach, y, z))];
      for (int x = 0; x <= 2 * kReach; ++x) {
        if (row[x].surfel < 0) continue;
        const float distance = (surfels_[row[x].surfel].p - p).squaredNorm();
        if (distance < least) least = distance, best = row[x].surfel;
      }
    }
  return best;
}

double ObjectModel::misfit(const SE3& T_camera_object, std::span<const SurfacePoint* const> points,
                           const ObservedSpace& space) const {
  // Compare the points with the surface.
  const Pose T(T_camera_object);
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / kMostPoints, ++count) {
    const Vector3f p = T.back(points[k]->p);
    const int i = nearest(p);
    sum += i < 0 ? kFar : std::min(kFar, (surfels_[i].p - p).norm());
  }

  return sum / std::max(count, 1) + kFar * contradicted(T_camera_object, space);
}

double ObjectModel::contradiction(const SE3& T_camera_object, std::span<const SurfacePoint* const> points,
                                  const ObservedSpace& space) const {
  int inside = 0, count = 0;
  const Pose T(T_camera_object);
  for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / kMostPoints, ++count) {
    const Vector3f p = T.back(points[k]->p);
    inside += seen_empty(p) && nearest(p) < 0;
  }
  return std::max(contradicted(T_camera_object, space), static_cast<double>(inside) / std::max(count, 1));
}

/// The share of the surfels at places that the frame shows to be empty.
double ObjectModel::contradicted(const SE3& T_camera_object, const ObservedSpace& space) const {
  const Pose T(T_camera_object);
  int count = 0, all = 0;
  for (std::size_t i = 0; i < surfels_.size(); i += 1 + surfels_.size() / kMostPoints, ++all) {
    const Vector3f p = T * surfels_[i].p;
    count += space.empty(p) || (faces_camera(T, surfels_[i]) && space.blank(p));
  }
  return static_cast<double>(count) / std::max(all, 1);
}

SE3 ObjectModel::centred(const SE3& predicted, std::span<const SurfacePoint* const> points,
                         const ObservedSpace& space) const {
  // Shift the model up to twice, so that the middle of its visible surface comes to lie on that of the points.
  Vector3f wanted = Vector3f::Zero();
  for (const SurfacePoint* point : points) wanted += point->p / static_cast<float>(points.size());
  SE3 pose = predicted;
  for (int round = 0; round < 2; ++round) {
    // Find the middle of the surfels that face the camera and are not hidden.
    const Pose T(pose);
    Vector3f sum = Vector3f::Zero();
    int count = 0;
    for (const Surfel& surfel : surfels_) {
      const Vector3f p = T * surfel.p;
      if (surfel.weight < kTrusted || !faces_camera(T, surfel)) continue;
      if (round > 0 && space.at(p) == ObservedSpace::Occupancy::unknown) continue;
      sum += p;
      ++count;
    }

    // Shift the model by the difference between the two.
    if (count < 8) break;
    pose.t += (wanted - sum / static_cast<float>(count)).cast<double>();
  }
  return pose;
}

SE3 ObjectModel::align(const SE3& predicted, std::span<const SurfacePoint* const> points, Matrix6d& covariance) const {
  // Express the prediction's uncertainty as information on the shift and the turn.
  const std::size_t step = 1 + points.size() / kMostPoints;
  Vector6d information;
  information << Eigen::Vector3d::Constant(1 / (kPredictedShift * kPredictedShift)),
      Eigen::Vector3d::Constant(1 / (kPredictedTurn * kPredictedTurn));
  SE3 pose = predicted;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // Add up the normal equations over the points and their nearest surfels.
    const Pose T(pose);
    Matrix6d A = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    double weights = 0;
    for (std::size_t k = 0; k < points.size(); k += step) {
      const int i = nearest(T.back(points[k]->p));
      if (i < 0 || surfels_[i].weight < kTrusted) continue;

      // Leave out the surfels that face another way.
      const Surfel& surfel = surfels_[i];
      const Vector3f n = T.R * surfel.n, place = T * surfel.p;
      if (n.dot(points[k]->n) < 0.5f) continue;

      // Weigh the distance along the normal robustly.
      const double r = n.dot(points[k]->p - place);
      const double weight = 1 / (1 + r * r / (kOutlier * kOutlier / 4));
      const Vector6d row = point_jacobian((place - T.t).cast<double>()).transpose() * n.cast<double>();
      A += weight * row * row.transpose();
      b += weight * r * row;
      weights += weight;
    }
    if (weights < 6) break;

    // Weigh them against the prediction.
    const double scale = std::min(1.0, kIndependent / weights) / (kPointDeviation * kPointDeviation);
    A *= scale;
    b *= scale;
    A.diagonal() += information;
    b += information.cwiseProduct(boxminus(predicted, pose));

    // Step to the solution, and stop when the step is small.
    covariance = A.inverse();
    const Vector6d twist = covariance * b;
    pose = boxplus(pose, twist);
    if (twist.head<3>().norm() < 1e-4 && twist.tail<3>().norm() < 1e-3) break;
  }
  return pose;
}

void ObjectModel::fuse(const SE3& T_camera_object, std::span<const SurfacePoint* const> points,
                       const ObservedSpace& space, bool credible) {
  if (cells_.empty()) cells_.resize(kSide * kSide * kSide);
  const Pose T(T_camera_object);
  if (credible)
    for (const SurfacePoint* point : points) add(T.back(point->p), T.R.transpose() * point->n);
  remove_contradicted(T_camera_object, space);
  see_empty_cells(T_camera_object, space);
}

/// Updates the counts of the cells around a surfel that was added or removed.
void ObjectModel::count_around(std::int32_t cell, int change) {
  const Vector3i i(cell % kSide, cell / kSide % kSide, cell / (kSide * kSide));
  const Vector3i first = (i.array() - kReach).max(0), last = (i.array() + kReach).min(kSide - 1);
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x)
        cells_[number({x, y, z})].around = static_cast<std::uint8_t>(cells_[number({x, y, z})].around + change);
}

void ObjectModel::add(const Vector3f& p, const Vector3f& n) {
  const std::int32_t c = cell_of(p);
  if (c < 0) return;
  Cell& cell = cells_[c];
  cell.empty = 0;

  // Create a surfel in a cell that has none.
  if (cell.surfel < 0) {
    if (surfels_.size() >= kMostSurfels) return;
    cell.surfel = static_cast<std::int16_t>(surfels_.size());
    surfels_.push_back({p, n, 1, c});
    count_around(c, 1);
    return;
  }

  // Average the point with the surfel of its cell.
  Surfel& surfel = surfels_[cell.surfel];
  const float share = 1 / (surfel.weight + 1);
  surfel.p += share * (p - surfel.p);
  const Vector3f mean = surfel.n + share * (n - surfel.n);
  if (mean.squaredNorm() > 1e-4f) surfel.n = mean.normalized();
  surfel.weight = std::min(kMostSeen, surfel.weight + 1);
}

/// Surfels at places that are seen to be empty lose weight until they are removed; so do, more slowly, those that
/// should be visible where no depth is measured.
void ObjectModel::remove_contradicted(const SE3& T_camera_object, const ObservedSpace& space) {
  const Pose T(T_camera_object);
  for (std::size_t i = 0; i < surfels_.size();) {
    Surfel& surfel = surfels_[i];

    // A surfel loses weight where the space is empty, or where it faces the camera and no depth is measured.
    const Vector3f p = T * surfel.p;
    if (space.empty(p))
      surfel.weight = 0.7f * surfel.weight - 0.3f;
    else if (faces_camera(T, surfel) && space.blank(p))
      surfel.weight -= kBlank;
    if (surfel.weight > 0.4f) {
      ++i;
      continue;
    }

    // Remove the surfel, and move the last one into its place.
    cells_[surfel.cell].surfel = -1;
    count_around(surfel.cell, -1);
    if (i + 1 < surfels_.size()) {
      surfel = surfels_.back();
      cells_[surfel.cell].surfel = static_cast<std::int16_t>(i);
    }
    surfels_.pop_back();
  }
}

/// Remembers which cells around the surface are seen to be empty.
void ObjectModel::see_empty_cells(const SE3& T_camera_object, const ObservedSpace& space) {
  if (surfels_.empty()) return;
  const Pose T(T_camera_object);
  const auto [lower, upper] = bounds();
  const Vector3i first = indices(lower - Vector3f::Constant(kAround)).cwiseMax(0),
                 last = indices(upper + Vector3f::Constant(kAround)).cwiseMin(kSide - 1);

  // In a large box, visit only some layers in each frame.
  const Vector3i size = (last - first).array() + 1;
  const int stride = 1 + size.prod() / kMostCells;
  layer_ = (layer_ + 1) % stride;
  const Vector3f step = kCell * T.R.col(0);

  // Count the frames in which a cell without a surfel was seen to be empty.
  for (int z = first.z() + layer_; z <= last.z(); z += stride)
    for (int y = first.y(); y <= last.y(); ++y) {
      Cell* row = &cells_[number({0, y, z})];
      Vector3f p = T * (kCell * (Vector3f(static_cast<float>(first.x()), static_cast<float>(y), static_cast<float>(z)) +
                                 Vector3f::Constant(0.5f - kSide / 2)));
      for (int x = first.x(); x <= last.x(); ++x, p += step)
        if (row[x].surfel < 0 && row[x].empty < kTrustedEmpty && space.empty(p)) ++row[x].empty;
    }
}

void ObjectModel::append_hidden(const SE3& T_camera_object, const ObservedSpace& space, std::int32_t object,
                                std::vector<SurfacePoint>& points) const {
  const Pose T(T_camera_object);
  for (const Surfel& surfel : surfels_) {
    if (surfel.weight < kTrusted) continue;
    const Vector3f p = T * surfel.p;
    if (space.at(p) != ObservedSpace::Occupancy::unknown) continue;
    SurfacePoint& point = points.emplace_back();
    point.p = p;
    point.n = T.R * surfel.n;
    point.object = object;
    point.component = -1;
  }
}

bool ObjectModel::seen_empty(const Vector3f& p) const {
  const std::int32_t c = cell_of(p);
  return c >= 0 && cells_[c].surfel < 0 && cells_[c].empty >= kTrustedEmpty;
}

std::vector<SurfaceSample> ObjectModel::surface() const {
  std::vector<SurfaceSample> samples;
  for (const Surfel& surfel : surfels_)
    if (surfel.weight >= kTrusted) samples.push_back({surfel.p, surfel.n});
  return samples;
}

std::array<Vector3f, 2> ObjectModel::bounds() const {
  if (surfels_.empty()) return {Vector3f::Zero(), Vector3f::Zero()};
  Vector3f lower = surfels_[0].p, upper = lower;
  for (const Surfel& surfel : surfels_) lower = lower.cwiseMin(surfel.p), upper = upper.cwiseMax(surfel.p);
  return {lower, upper};
}

}  // namespace barehand
