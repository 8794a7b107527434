#include "drivers/synthetic/people/arm.h"

#include <algorithm>
#include <cmath>

namespace barehand::synthetic {

Eigen::Vector3d elbow_between(const ArmSize& arm, const Eigen::Vector3d& shoulder, const Eigen::Vector3d& wrist,
                              const Eigen::Vector3d& towards) {
  // Shoulder, elbow and wrist form a triangle; the law of cosines gives its angle at the shoulder.
  const Eigen::Vector3d along = (wrist - shoulder).normalized();
  const double distance =
      std::clamp((wrist - shoulder).norm(), std::abs(arm.upper - arm.forearm) + 1e-3, arm.reach() - 1e-3);
  const double cosine =
      (arm.upper * arm.upper + distance * distance - arm.forearm * arm.forearm) / (2 * arm.upper * distance);

  // The triangle lies in the plane of the arm and `towards`.
  const Eigen::Vector3d side = (towards - towards.dot(along) * along).normalized();
  return shoulder + arm.upper * (cosine * along + std::sqrt(std::max(0.0, 1 - cosine * cosine)) * side);
}

}  // namespace barehand::synthetic
