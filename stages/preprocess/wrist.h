#pragma once

#include <optional>

#include "stages/preprocess/image/components.h"

namespace barehand {

/// The plane where the hand ends: points with (p - point) . axis > 0 are forearm. Camera frame [m].
struct WristPlane {
  Eigen::Vector3f point, axis;
  float behind(const Eigen::Vector3f& p) const { return (p - point).dot(axis); }
};

/// Finds the wrist of a hand with forearm from its outline alone: along the axis from the fingertips towards the arm
/// (the end that leaves the image, or else the one with less outline) the width rises to that of the palm, then falls
/// to that of the wrist. None if there is no such place, for example if the part is no longer than a hand.
std::optional<WristPlane> find_wrist(const CoarseGrid& grid, const Components& surfaces, int part);

}  // namespace barehand
