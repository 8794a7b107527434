// Hands of which the image shows only a part.
#include "stages/search/cut_hand.h"

#include <algorithm>

namespace barehand {
namespace {

using Eigen::Vector3d;

constexpr double kNearBorder = 0.02;  // a joint this near to the border may be one that lies beyond it [m]
constexpr int kFarthest = 2;          // largest number of places by which fingers are moved
constexpr int kFirst = 1, kLast = 4;  // index and little finger
// Factors on the covariance of a finger that nothing was taken for, and of the wrist and the thumb's first joint, which
// move with the fingers.
constexpr double kInvented = 100, kMovedAlong = 4;

DetectedJoints moved(const DetectedJoints& joints, int places) {
  const auto knuckle = [&](int finger) { return joints[landmark_of(finger, 0)].position; };
  const Vector3d across = (knuckle(kLast) - knuckle(kFirst)) / (kLast - kFirst);  // from one finger to the next

  // Each finger gets the joints of the one that many places further, or of the last one if there is none.
  DetectedJoints out = joints;
  for (int finger = kFirst; finger <= kLast; ++finger) {
    const int wanted = finger + places, there = std::clamp(wanted, kFirst, kLast);
    for (int k = 0; k < 4; ++k) {
      DetectedJoint& joint = out[landmark_of(finger, k)] = joints[landmark_of(there, k)];
      joint.position += (wanted - there) * across;
      if (wanted != there) joint.covariance *= kInvented;
    }
  }

  // The base of the hand moves with the fingers.
  for (const int landmark : {kWristLandmark, landmark_of(0, 0)}) {
    out[landmark].position += places * across;
    out[landmark].covariance *= kMovedAlong;
  }
  return out;
}

DetectedJoints with_thumb_spread(const DetectedJoints& joints) {
  const auto at = [&](int landmark) { return joints[landmark].position; };
  const Vector3d aside = at(landmark_of(kFirst, 0)) - at(landmark_of(kLast, 0)),
                 forwards = at(kMiddleKnuckleLandmark) - at(kWristLandmark),
                 direction = (aside.normalized() + forwards.normalized()).normalized();
  DetectedJoints out = joints;
  for (int k = 0; k < 4; ++k) {
    DetectedJoint& joint = out[landmark_of(0, k)];
    joint.covariance *= kInvented;
    if (k == 0) continue;
    const double bone = (at(landmark_of(0, k)) - at(landmark_of(0, k - 1))).norm();
    joint.position = out[landmark_of(0, k - 1)].position + bone * direction;
  }
  return out;
}

}  // namespace

bool cut_by_border(const DetectedJoints& joints, const Intrinsics& camera) {
  return std::ranges::any_of(joints, [&](const DetectedJoint& joint) {
    const Vector3d& p = joint.position;
    const Eigen::Vector2d pixel = camera.project(p);
    const double u = kNearBorder * camera.fx / p.z(), v = kNearBorder * camera.fy / p.z();
    return pixel.x() < u || pixel.x() > camera.width - 1 - u || pixel.y() < v || pixel.y() > camera.height - 1 - v;
  });
}

std::vector<DetectedJoints> with_fingers_moved(const DetectedJoints& joints) {
  std::vector<DetectedJoints> out{with_thumb_spread(joints)};
  for (int places = 1; places <= kFarthest; ++places) {
    out.push_back(moved(joints, places));
    out.push_back(moved(joints, -places));
  }
  return out;
}

}  // namespace barehand
