#pragma once

#include <algorithm>
#include <cmath>

#include "hand/gaussian_tree.h"
#include "hand/hand_pose.h"

namespace barehand::test {

/// Largest deviation of -g from half the numeric gradient of `energy(pose)`, relative to the largest component.
/// Components of rotations are divided by `arm` [m] to make them comparable with translations.
template <class Energy>
double gradient_error(const Energy& energy, const HandPose& pose, const GaussianTree& tree, double step,
                      double arm = 1) {
  double worst = 0, scale = 0;

  // Move every segment along every axis.
  for (int s = 0; s < kSegmentCount; ++s)
    for (int i = 0; i < 6; ++i) {
      const auto at = [&](double h) {
        HandPose moved = pose;
        moved[s] = boxplus(moved[s], h * Vector6d::Unit(i));
        return energy(moved);
      };

      const double unit = i < 3 ? 1 : arm;
      const double numeric = 0.5 * (at(step) - at(-step)) / (2 * step);
      worst = std::max(worst, std::abs(numeric + tree.g[s][i]) / unit);
      scale = std::max(scale, std::abs(numeric) / unit);
    }
  return worst / scale;
}

}  // namespace barehand::test
