#include "drivers/synthetic/grasps/opposition.h"

#include <algorithm>
#include <cmath>

#include "math/angles.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

/// Ranges of the joints in contact [rad]: abduction, then flexion from the palm to the tip.
struct Limits {
  double lower, upper;
};
constexpr std::array<Limits, 4> kThumbLimits = {{{-25 * kDegree, 40 * kDegree},
                                                 {-20 * kDegree, 40 * kDegree},
                                                 {-10 * kDegree, 55 * kDegree},
                                                 {-12 * kDegree, 75 * kDegree}}};
constexpr std::array<Limits, 4> kFingerLimits = {
    {{-14 * kDegree, 16 * kDegree}, {-15 * kDegree, 92 * kDegree}, {0, 108 * kDegree}, {-4 * kDegree, 70 * kDegree}}};

constexpr double kBesideRest = 0.002;  // room between a rod and what it leans against [m]
constexpr double kFacing = 120;        // weight of a touch that does not face the object

double& angle_of(FingerAngles& finger, int i) { return i == 0 ? finger.abduction : finger.flexion[i - 1]; }
double angle_of(const FingerAngles& finger, int i) { return i == 0 ? finger.abduction : finger.flexion[i - 1]; }

}  // namespace

Opposition::Opposition(const HandRig& rig, const GraspRecipe& recipe, const Hold& hold)
    : profile_(rig.profile),
      along_(recipe.along),
      kind_(hold.kind),
      radius_(hold.width / 2),
      least_abduction_(recipe.least_abduction),
      most_abduction_(recipe.most_abduction),
      first_count_(recipe.first.size()) {
  // Find the touches on the skin, and the fingers that may move.
  for (const auto* touches : {&recipe.first, &recipe.second})
    for (const Touch& touch : *touches) {
      touches_.push_back(on_skin(rig.mesh, touch));
      moves_[finger_of(touch.segment)] = true;
    }
  if (recipe.rest) rest_ = on_skin(rig.mesh, *recipe.rest);
}

Opposition::SkinPlace Opposition::on_skin(const HandMesh& mesh, const Touch& touch) const {
  // The skin is as far from the bone as its farthest vertex near this place.
  const SE3 T_segment_hand = mesh.T_hand_joint[joint_of_segment(touch.segment)].inverse();
  const Vector3d bone = touch.along * profile_.segments[touch.segment].distal;
  double radius = 0.004;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.segment_weight(v, touch.segment) < 0.5f) continue;
    const Vector3d out = T_segment_hand * mesh.vertices[v].cast<double>() - bone;
    if (std::abs(out.z()) < 0.005) radius = std::max(radius, out.dot(touch.direction));
  }
  return {touch.segment, bone + radius * touch.direction, touch.direction};
}

SE3 Opposition::hold_of(const HandPose& pose) const {
  // The touches form two groups on opposite sides of the object. The y axis points from the first group to the second.
  std::vector<Vector3d> places;
  Vector3d first = Vector3d::Zero(), second = Vector3d::Zero();
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    places.push_back(pose[touches_[i].segment] * touches_[i].place);
    (i < first_count_ ? first : second) += places.back();
  }

  // The centre lies midway between the means of both.
  first /= static_cast<double>(first_count_);
  second /= static_cast<double>(places.size() - first_count_);
  Vector3d y = second - first;
  Vector3d centre = 0.5 * (first + second);

  // A slab lies against a row of fingers, wherever the thumb is on its other side.
  const Vector3d row = places.back() - places[first_count_];
  Vector3d to_fingers = Vector3d::Zero(), to_palm = Vector3d::Zero();
  for (std::size_t i = first_count_; i < touches_.size(); ++i) {
    to_fingers -= pose[touches_[i].segment].R * touches_[i].normal;
    to_palm += pose[touches_[i].segment].R.col(2);
  }

  // Turn the slab against the row if the fingers form one.
  const bool on_row = kind_ == HoldKind::slab && row.norm() > 0.01;
  if (on_row) {
    y = to_fingers - to_fingers.dot(row) / row.squaredNorm() * row;
    centre = second - 0.5 * (second - first).dot(y.normalized()) * y.normalized();
  }
  y.normalize();

  // A rod that leans against the hand points to the place where it leans.
  Vector3d along = on_row ? Vector3d(to_palm - to_palm.dot(row) / row.squaredNorm() * row) : along_;
  if (rest_) {
    const SE3& T = pose[rest_->segment];
    along = T * rest_->place + (radius_ + kBesideRest) * (T.R * rest_->normal) - centre;
  }

  // Make the axes orthogonal.
  const Vector3d x = (along - along.dot(y) * y).normalized();
  SE3 T;
  T.R << x, y, x.cross(y);
  T.t = centre;
  return T;
}

double Opposition::cost(const HandAngles& angles, const HandAngles& comfortable) const {
  // Where the touches are in the frame of the hold.
  const HandPose pose = pose_segments(profile_, {SE3{}, angles});
  std::vector<Vector3d> places;
  for (const SkinPlace& touch : touches_) places.push_back(pose[touch.segment] * touch.place);
  const SE3 T_hold_palm = hold_of(pose).inverse();

  // Every touch should be on the surface, and face it.
  double sum = 0;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    Vector3d from_axis = T_hold_palm * places[i];
    if (kind_ == HoldKind::rod) from_axis.x() = 0;
    if (kind_ == HoldKind::slab) from_axis.x() = from_axis.z() = 0;
    const Vector3d normal = T_hold_palm.R * (pose[touches_[i].segment].R * touches_[i].normal);
    const double off_mm = 1e3 * (from_axis.norm() - radius_);
    sum += off_mm * off_mm + kFacing * (1 + normal.dot(from_axis.normalized()));
    // Fingers lie side by side.
    for (std::size_t j = 0; j < i; ++j) {
      const double apart_mm = 1e3 * (places[i] - places[j]).norm();
      if (finger_of(touches_[i].segment) != finger_of(touches_[j].segment) && (i < first_count_) == (j < first_count_))
        sum += std::pow(std::max(0.0, 15 - apart_mm), 2);
    }
  }

  // The rod should touch what it leans against.
  if (rest_) {
    Vector3d from_axis = T_hold_palm * (pose[rest_->segment] * rest_->place);
    from_axis.x() = 0;
    const double off_mm = 1e3 * (from_axis.norm() - radius_ - kBesideRest);
    sum += 2 * off_mm * off_mm;
  }

  // The hand should be near the comfortable one.
  for (int finger = 0; finger < kFingerCount; ++finger)
    for (int i = 0; i < 4; ++i) {
      const double strain =
          (angle_of(angles[finger], i) - angle_of(comfortable[finger], i)) / ((i == 0 ? 10 : 25) * kDegree);
      sum += strain * strain;
    }
  return sum;
}

OpposedGrasp Opposition::solve(const HandAngles& comfortable) const {
  HandAngles best = comfortable;
  double least = cost(best, comfortable);
  for (double step = 16 * kDegree; step > 0.1 * kDegree;) {
    // Try every joint in both directions.
    bool better = false;
    for (int finger = 0; finger < kFingerCount; ++finger)
      for (int i = 0; i < 4 && moves_[finger]; ++i)
        for (const double sign : {-1.0, 1.0}) {
          // Turn the joint by one step within its limits.
          HandAngles tried = best;
          Limits limits = (finger == 0 ? kThumbLimits : kFingerLimits)[i];
          if (finger == 0 && i == 0) limits = {least_abduction_, most_abduction_};
          double& angle = angle_of(tried[finger], i);
          angle = std::clamp(angle + sign * step, limits.lower, limits.upper);

          // Keep the change if it lowers the cost.
          const double now = cost(tried, comfortable);
          if (now >= least - 1e-9) continue;
          least = now;
          best = tried;
          better = true;
        }

    // Halve the step when no change helps any more.
    if (!better) step /= 2;
  }

  return {best, hold_of(pose_segments(profile_, {SE3{}, best}))};
}

}  // namespace barehand::synthetic
