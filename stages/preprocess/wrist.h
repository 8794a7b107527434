#pragma once

#include <optional>

#include "stages/preprocess/image/components.h"

namespace barehand {

/// The plane where the hand ends: points with (p - point) . axis > 0 are forearm. Camera frame [m].
struct WristPlane {
  Eigen::Vector3f point, axis;
  float behind(const Eigen::Vector3f& p) const { return (p - point).dot(axis); }
  /// Whether a point is on the forearm, that is, in a cylinder behind the plane.
  bool on_forearm(const Eigen::Vector3f& p) const {
    constexpr float kLength = 0.35f, kRadius = 0.07f;  // of the cylinder [m]
    const float back = behind(p);
    return back > 0 && back < kLength && (p - point - back * axis).squaredNorm() < kRadius * kRadius;
  }
};

/// Finds the wrist of a hand with forearm from its outline alone: along the axis from the fingertips towards the arm
/// (the end that leaves the image, or else the one with less outline) the width rises to that of the palm, then falls
/// to that of the wrist. None if there is no such place, for example if the part is no longer than a hand.
std::optional<WristPlane> find_wrist(const CoarseGrid& grid, const Components& surfaces, int part);

}  // namespace barehand
