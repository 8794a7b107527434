// Random keyframes for the motion of a simulated person's hand.
#include "drivers/synthetic/people/hand_wandering.h"

#include <algorithm>

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

constexpr double kStep = 0.75;  // time between two keyframes [s]

/// The angles of a finger between an open hand (`curl` 0) and a fist (`curl` 1).
FingerAngles bent(int finger, double curl) {
  static const HandAngles kOpen = open_spread(), kClosed = fist();
  const auto between = [curl](double open, double closed) { return (1 - curl) * open + curl * closed; };
  FingerAngles angles{between(kOpen[finger].abduction, kClosed[finger].abduction), {}};
  for (int k = 0; k < 3; ++k) angles.flexion[k] = between(kOpen[finger].flexion[k], kClosed[finger].flexion[k]);
  return angles;
}

/// A random shape of the hand: all fingers bent by similar amounts, some bent and others straight (as in counting and
/// pointing), or each bent by its own amount.
HandAngles random_shape(KeyedRandom& random) {
  const double kind = random.uniform(), common = random.uniform();
  HandAngles hand;
  for (int finger = 0; finger < kFingerCount; ++finger) {
    const double own = random.uniform();
    const double alike = std::clamp(common + 0.2 * (own - 0.5), 0.0, 1.0), straight_or_bent = own < 0.5 ? 0.05 : 0.95;
    hand[finger] = bent(finger, kind < 0.5 ? alike : kind < 0.8 ? straight_or_bent : own);
  }
  return hand;
}

}  // namespace

Vector3d random_within(const Vector3d& range, KeyedRandom& random) {
  Vector3d point;
  for (int i = 0; i < 3; ++i) point[i] = random.uniform(-range[i], range[i]);
  return point;
}

Eigen::Matrix3d palm_facing(const Vector3d& fingers, const Vector3d& facing) {
  Eigen::Matrix3d R;
  R.col(2) = -fingers.normalized();
  R.col(1) = (-facing + facing.dot(R.col(2)) * R.col(2)).normalized();
  R.col(0) = R.col(1).cross(R.col(2));
  return R;
}

std::vector<HandKey> wander(const HandWandering& wandering, KeyedRandom& random) {
  std::vector<HandKey> keys;
  for (double time = 0; time < wandering.duration + kStep; time += kStep) {
    HandKey key;
    key.time = time;
    key.turn = random_within(Vector3d::Constant(wandering.turn), random);
    const Vector3d fingers = -(exp_so3(key.turn) * wandering.base).col(2);
    key.position = wandering.centre + random_within(wandering.range, random) - kWristToMiddle * fingers;
    key.angles = random_shape(random);
    keys.push_back(key);
  }
  return keys;
}

}  // namespace barehand::synthetic
