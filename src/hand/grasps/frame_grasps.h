#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>

#include "core/memory/frame_memory.h"
#include "hand/grasps/grasp_types.h"

namespace barehand {

// How the hands of one frame grasp.

/// Number of grasp classes, including "no grasp", which has index 0. Class k of grasp_types() has index k + 1.
inline constexpr int kGraspCount = 1 + kGraspTypeCount;
/// The probability of each of these classes, by its index.
using GraspProbabilities = std::array<double, kGraspCount>;

/// How one hand grasps, according to its pose.
struct HandGrasp {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  bool known = false;  ///< whether the hand is tracked; if not, the other members are meaningless
  GraspProbabilities probabilities{};
  int grasp = 0;               ///< 0: none, otherwise 1 + the index in grasp_types()
  std::int64_t since = 0;      ///< time of the first frame with the present `grasp` [us since the epoch]
  double aperture = kUnknown;  ///< distance from the thumb's tip to the mean of the tips of virtual finger 2 [m]
  double closure = kUnknown;   ///< mean flexion of the fingers relative to their range: 0 flat, 1 fist
};

/// How the hands of one frame grasp, in the order of the frame's estimates. Immutable once shared.
using FrameGrasps = FrameVector<HandGrasp>;
using FrameGraspsPtr = std::shared_ptr<const FrameGrasps>;

}  // namespace barehand
