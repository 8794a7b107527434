// Improves a pose by a random local search over the palm's pose and the joint angles.
#include "stages/search/pose_search.h"

#include <cmath>

namespace barehand {

namespace {

using Eigen::Vector3d;

/// Sum of the squared differences in flexion between neighbouring fingers (without the thumb), per joint [rad^2].
double shape_roughness(const std::array<JointAngles, kSegmentCount>& angles) {
  double sum = 0;
  for (int finger = 1; finger + 1 < kFingerCount; ++finger) {
    for (int k = 0; k < 3; ++k) {
      const double d = angles[segment_of(finger, k)].flexion - angles[segment_of(finger + 1, k)].flexion;
      sum += d * d / 9;
    }
  }
  return sum;
}

/// Draws random changes of a pose. Each changes one group of degrees of freedom: the position, the orientation, the
/// flexion of all fingers, or one finger.
class MoveMaker {
 public:
  MoveMaker(KeyedRandom& random, const PoseSearchParams& params, const Vector3d& pivot_in_palm)
      : random_(random), params_(params), pivot_(pivot_in_palm) {}

  ArticulatedPose operator()(ArticulatedPose pose, double scale) {
    const double which = random_.uniform();
    if (which < 0.2) {
      pose.T_camera_palm.t += scale * params_.translation * normal3();
    } else if (which < 0.45) {
      rotate(pose.T_camera_palm, scale * params_.rotation * normal3());
    } else if (which < 0.55) {
      const double angle = scale * params_.flexion * random_.normal();
      for (int finger = 1; finger < kFingerCount; ++finger) flex(pose, finger, angle);
    } else {
      change_finger(pose, std::min(kFingerCount - 1, static_cast<int>(kFingerCount * random_.uniform())), scale);
    }
    return pose;
  }

 private:
  Vector3d normal3() {
    const double x = random_.normal(), y = random_.normal(), z = random_.normal();
    return {x, y, z};
  }

  /// Rotates about the centre of the palm, so that the hand stays where it is.
  void rotate(SE3& T, const Vector3d& w) const {
    const Vector3d centre = T * pivot_;
    T.R = exp_so3(w) * T.R;
    T.t = centre - T.R * pivot_;
  }

  static void flex(ArticulatedPose& pose, int finger, double angle) {
    constexpr std::array<double, 3> kCoupling = {0.7, 1.0, 0.67};
    for (int k = 0; k < 3; ++k) pose.angles[segment_of(finger, k)].flexion += kCoupling[k] * angle;
  }

  void change_finger(ArticulatedPose& pose, int finger, double scale) {
    const double which = random_.uniform(), angle = scale * params_.flexion * random_.normal();
    JointAngles& base = pose.angles[segment_of(finger, 0)];
    JointAngles& middle = pose.angles[segment_of(finger, 1)];

    // Bend the whole finger, its base or its outer joints; or spread it.
    if (which < 0.3) {
      flex(pose, finger, angle);
    } else if (which < 0.55) {
      base.flexion += angle;
    } else if (which < 0.75) {
      middle.flexion += angle;
      pose.angles[segment_of(finger, 2)].flexion += 0.67 * angle;
    } else {
      base.abduction += scale * params_.abduction * random_.normal() * (finger == 0 ? 2 : 1);
      middle.abduction += scale * params_.abduction * random_.normal();  // clamp_angles() undoes it except on the thumb
    }
  }

  KeyedRandom& random_;
  const PoseSearchParams& params_;
  Vector3d pivot_;
};

}  // namespace

double PoseCost::operator()(const ArticulatedPose& pose) {
  return scorer_(posed(profile_, pose)) + shape_prior_ * shape_roughness(pose.angles);
}

ScoredPose search_pose(ScoredPose start, PoseCost& cost, const std::array<JointLimits, kSegmentCount>& limits,
                       int evaluations, KeyedRandom random, const PoseSearchParams& params) {
  MoveMaker move(random, params, Vector3d(0, 0, -0.06));
  ScoredPose best = std::move(start);
  for (int i = 0; i < evaluations; ++i) {
    const double scale = std::pow(params.final_step, i / std::max(1.0, evaluations - 1.0));
    ScoredPose trial{move(best.articulated, scale), 0};
    clamp_angles(trial.articulated.angles, limits);
    trial.cost = cost(trial.articulated);
    if (trial.cost < best.cost) best = trial;
  }
  return best;
}

}  // namespace barehand
