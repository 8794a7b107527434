// Fits balls and cylinders to what is seen of an object.
#include "object/round_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "math/random.h"
#include "math/square.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kLeastSamples = 30;              // fewer show no shape
constexpr double kThinnest = 0.008, kThickest = 0.06;  // radii that a hand closes around [m]
constexpr double kNear = 0.004;       // samples within this distance of the shape lie on it, if their normal agrees [m]
constexpr double kFacing = 0.5;       // cosine up to which normals agree
constexpr double kLeastOn = 0.35;     // share of the samples that must lie on the shape
constexpr double kMostOutside = 0.2;  // share of the samples that may lie outside of it, such as a handle
// RMS distance of the samples that lie on the shape, over its radius. Things that are round have 0.01 to 0.02, a die
// and a pair of pliers 0.06.
constexpr double kRoughest = 0.025;
constexpr double kSimpler = 0.05;  // share of the samples by which a cylinder must explain more than a ball

constexpr int kTrials = 100;           // pairs of samples that are tried
constexpr std::size_t kScored = 100;   // samples by which each is judged
constexpr double kLeastTurn = 0.2;     // sine of the angle between a pair's normals
constexpr int kIterations = 12;        // of least squares
constexpr double kDeviation = 0.0015;  // of a sample [m]
constexpr double kIndependent = 80;    // all samples tell as much as so many whose errors are independent
constexpr double kPrior = 0.05;        // deviation of each unknown without data [m, rad]
constexpr double kFixed = 1e-4;        // the same of the centre along a cylinder's axis, on which nothing depends [m]
constexpr double kWall = 0.003, kWallDeviation = 0.002;  // thickness of the wall of a hollow thing [m]

/// One kind of shape, fitted to samples.
class Fit {
 public:
  /// `hollow`: the samples are on the inside.
  Fit(std::span<const SurfaceSample> surface, bool cylinder, bool hollow)
      : surface_(surface), cylinder_(cylinder), outwards_(hollow ? -1 : 1) {}

  /// None if the samples do not show such a shape.
  std::optional<RoundShape> run() {
    if (!start()) return std::nullopt;
    for (int i = 0; i < kIterations; ++i)
      if (!step()) return std::nullopt;
    return finished();
  }
  /// Share of the samples that lie on the shape less the share of those outside of it.
  double share() const { return support(shape_).share(); }

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
  /// Which samples lie where, as shares of all.
  struct Support {
    double on = 0, outside = 0;
    double share() const { return on - outside; }
  };

  static Vector3d across(const RoundShape& shape, const Vector3d& v) { return v - shape.axis * shape.axis.dot(v); }
  Vector3d normal(const SurfaceSample& sample) const { return outwards_ * sample.n.cast<double>(); }
  bool faces(const SurfaceSample& sample, const Vector3d& direction) const {
    return normal(sample).dot(direction) > kFacing;
  }

  Support support(const RoundShape& shape) const {
    Support result;
    const std::size_t step = 1 + surface_.size() / kScored;
    const double each = 1 / std::ceil(static_cast<double>(surface_.size()) / static_cast<double>(step));
    for (std::size_t i = 0; i < surface_.size(); i += step) {
      const Vector3d out = across(shape, surface_[i].p.cast<double>() - shape.centre);
      const double far = out.norm(), distance = far - shape.radius;
      if (distance > kNear) result.outside += each;
      if (std::abs(distance) < kNear && faces(surface_[i], out / far)) result.on += each;
    }
    return result;
  }

  /// Begins with the best of the shapes that two samples and their normals determine. False if there is none.
  bool start() {
    KeyedRandom random(0, cylinder_, outwards_ < 0);
    double best = 0;
    for (int i = 0; i < kTrials; ++i) {
      const SurfaceSample& first = surface_[random.bits() % surface_.size()];
      const SurfaceSample& second = surface_[random.bits() % surface_.size()];
      const Vector3d dn = normal(second) - normal(first), both = normal(first).cross(normal(second));
      if (both.norm() < kLeastTurn) continue;

      // p - r n is the centre for both; the axis of a cylinder is perpendicular to both normals.
      RoundShape trial;
      if (cylinder_) trial.axis = both.normalized();
      const Vector3d dp = across(trial, (second.p - first.p).cast<double>());
      trial.radius = dp.dot(dn) / dn.squaredNorm();
      if (trial.radius < kThinnest || trial.radius > kThickest || (dp - trial.radius * dn).norm() > kNear) continue;
      trial.centre = first.p.cast<double>() - trial.radius * normal(first);
      const double share = support(trial).share();
      if (share <= best) continue;
      best = share;
      shape_ = trial;
    }
    return best > 0;
  }

  /// One step of Gauss and Newton, robust by Geman-McClure weights. The unknowns are the centre, the radius, and the
  /// turn of a cylinder's axis. False if nothing is left of the shape.
  bool step() {
    const int unknowns = cylinder_ ? 6 : 4;
    const Vector3d a = cylinder_ ? Vector3d(shape_.axis.unitOrthogonal()) : Vector3d(Vector3d::Zero());
    const Vector3d b = shape_.axis.cross(a);
    Matrix A = Matrix::Zero(unknowns, unknowns);
    Vector g = Vector::Zero(unknowns), row(unknowns);
    double weights = 0;
    seen_.setZero();
    for (const SurfaceSample& sample : surface_) {
      const Vector3d q = sample.p.cast<double>() - shape_.centre, out = across(shape_, q);
      const Vector3d direction = out.normalized();
      if (!faces(sample, direction)) continue;
      const double distance = out.norm() - shape_.radius;

      // The derivative of the distance by the unknowns: turning a cylinder by t moves its axis by t x axis.
      row.head<3>() = -direction;
      row[3] = -1;
      if (cylinder_) row.tail<2>() = shape_.axis.dot(q) * Eigen::Vector2d(direction.dot(b), -direction.dot(a));
      const double weight = 1 / square(1 + square(distance / kNear));
      A += weight * row * row.transpose();
      g -= weight * distance * row;
      seen_ += weight * direction;
      weights += weight;
    }
    if (weights < kLeastOn * kLeastSamples) return false;

    // Solve for the step.
    const double information = std::min(1.0, kIndependent / weights) / square(kDeviation);
    A *= information;
    A.diagonal().array() += 1 / square(kPrior);
    A.topLeftCorner<3, 3>() += shape_.axis * shape_.axis.transpose() / square(kFixed);
    covariance_ = A.inverse();
    const Vector x = information * covariance_ * g;
    shape_.centre += x.head<3>();
    shape_.radius += x[3];
    if (cylinder_) shape_.axis = (shape_.axis + (x[4] * a + x[5] * b).cross(shape_.axis)).normalized();
    return shape_.radius > 0 && shape_.radius < 2 * kThickest;
  }

  std::optional<RoundShape> finished() {
    // Judge the shape by the samples.
    const Support all = support(shape_);
    if (all.on < kLeastOn || all.outside > kMostOutside) return std::nullopt;
    if (shape_.radius < kThinnest || shape_.radius > kThickest) return std::nullopt;
    double squares = 0, count = 0, low = INFINITY, high = -INFINITY;
    for (const SurfaceSample& sample : surface_) {
      const Vector3d q = sample.p.cast<double>() - shape_.centre, out = across(shape_, q);
      if (std::abs(out.norm() - shape_.radius) > kNear || !faces(sample, out.normalized())) continue;
      squares += square(out.norm() - shape_.radius);
      ++count;
      low = std::min(low, shape_.axis.dot(q));
      high = std::max(high, shape_.axis.dot(q));
    }
    if (!(std::sqrt(squares / count) < kRoughest * shape_.radius)) return std::nullopt;

    // The opposite side moves with the centre and with the radius.
    RoundShape result = shape_;
    Vector row = Vector::Zero(covariance_.rows());
    row.head<3>() = -seen_.normalized();
    row[3] = 1;
    result.deviation = std::sqrt(row.dot(covariance_ * row));
    if (outwards_ < 0) {
      result.radius += kWall;
      result.deviation = std::hypot(result.deviation, kWallDeviation);
    }

    // A cylinder is as long as it was seen.
    if (!cylinder_) return result;
    result.centre += 0.5 * (low + high) * result.axis;
    result.half_length = 0.5 * (high - low);
    return result;
  }

  std::span<const SurfaceSample> surface_;
  bool cylinder_;
  double outwards_;  // 1, or -1 if normals point to the middle
  RoundShape shape_;
  Matrix covariance_;                 // of the unknowns
  Vector3d seen_ = Vector3d::Zero();  // sum of the directions from the centre to what is seen
};

}  // namespace

double RoundShape::distance(const Vector3d& p) const {
  const Vector3d q = p - centre;
  if (half_length == 0) return q.norm() - radius;
  const double along = axis.dot(q), out = (q - along * axis).norm() - radius, beyond = std::abs(along) - half_length;
  return out > 0 && beyond > 0 ? std::hypot(out, beyond) : std::max(out, beyond);
}

std::optional<RoundShape> fit_round_shape(std::span<const SurfaceSample> surface) {
  std::optional<RoundShape> best;
  if (surface.size() < kLeastSamples) return best;
  double most = 0;
  for (const bool hollow : {false, true})
    for (const bool cylinder : {false, true}) {
      Fit fit(surface, cylinder, hollow);
      const auto shape = fit.run();
      const double share = fit.share();
      if (!shape || share < most + (cylinder ? kSimpler : 0)) continue;
      best = shape;
      most = share;
    }
  return best;
}

KnownObjectPtr make_round_object(const RoundShape& shape, std::int32_t id) {
  constexpr double kCell = 0.006;  // of the grid [m]; between its nodes a radius of 20 mm is off by up to 0.2 mm
  const auto distance = [&](const Eigen::Vector3f& p) { return static_cast<float>(shape.distance(p.cast<double>())); };
  const Eigen::Array3d sides = (1 - shape.axis.array().square()).max(0).sqrt();
  const Vector3d reach = shape.half_length * shape.axis.cwiseAbs() + shape.radius * sides.matrix();
  DistanceGrid grid(distance, shape.centre - reach, shape.centre + reach, kCell);
  return std::make_shared<KnownObject>(
      KnownObject{"round", id, std::move(grid), {}, shape.centre, 2 * reach, reach.norm(), {}});
}

}  // namespace barehand
