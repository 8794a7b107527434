#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "stages/preprocess/coarse_hand.h"

namespace barehand {

/// Remembers the depth that each cell of the coarse grid has shown for a while without a hand. A table or a stand that
/// is coloured like skin, and that the hand touches, differs from the hand in that it was there before. If most of what
/// stood there has gone, as when the sensor moves, everything is forgotten.
class StandingDepth {
 public:
  /// Learns from the cells that may be skin; to be called once a frame, after the hands were found in it. Cells near a
  /// hand or its forearm learn nothing, but forget where something farther away shows. Cells around a hand that was not
  /// tracked until now forget everything, since the hand itself may have stood there.
  void update(const CoarseGrid& grid, std::span<const CoarseHand> hands, std::int64_t utime);

  /// Depth [m] of what stands in the cell (column, row); 0 = nothing is known.
  float depth(int column, int row) const {
    return seconds_.contains(column, row) && seconds_.at(column, row) >= kStands ? depth_.at(column, row) : 0.f;
  }
  /// Largest difference [m] to a standing depth that is explained by noise.
  static float tolerance(float standing) { return 4 * depth_noise(standing); }
  static bool agrees(float z, float standing) { return std::abs(z - standing) < tolerance(standing); }

 private:
  static constexpr float kStands = 0.5f;  // time after which an unchanged surface counts as standing [s]
  bool sensor_moved(const CoarseGrid& grid) const;
  void forget_around(const CoarseGrid& grid, const CoarseHand& hand);

  Image<float> depth_;    // remembered depth of each cell [m]; 0 = none
  Image<float> seconds_;  // for how long the cell has shown it [s]
  std::int64_t utime_ = 0;
};

}  // namespace barehand
