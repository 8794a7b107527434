#pragma once

#include <array>
#include <optional>

namespace barehand {

/// How far the last joint of a finger bends, as a fraction of the joint before it.
inline constexpr double kDistalShare = 2.0 / 3;

/// Flexion of the three joints of a finger, from its root to its tip [rad].
using FingerFlexion = std::array<double, 3>;

/// What the objects that a hand grips say about one of its hidden fingers.
struct FingerHold {
  double rests = 0;  ///< how firmly its tip rests on an object, from 0 to 1
  /// Flexion at which the finger is closed on an object; none: it is seen, or closing it would miss the object.
  std::optional<FingerFlexion> closed;

  /// Whether an object keeps the finger where it is.
  bool firm() const { return closed || rests > 0.5; }
};

}  // namespace barehand
