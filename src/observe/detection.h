#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/image.h"
#include "hand/segments.h"

namespace barehand {

// Results of the networks that detect hands.

/// The classes that the detection networks assign to pixels.
enum class SurfaceLabel : std::uint8_t { background = 0, hand = 1, arm = 2, object = 3 };
inline constexpr int kSurfaceLabelCount = 4;

/// The networks' labels of a rectangle ("window") of the frame, on a grid coarser than the frame's pixels. The centre
/// of cell (c, r) is the frame pixel (u0 + c * step_u, v0 + r * step_v).
struct LabelMap {
  Image<SurfaceLabel> label;
  Image<float> hand_log_odds;  ///< log odds of the hand against all other classes
  double u0 = 0, v0 = 0, step_u = 1, step_v = 1;

  /// Whether frame pixel (u, v) lies in the window.
  bool covers(double u, double v) const {
    const double c = (u - u0) / step_u, r = (v - v0) / step_v;
    return c >= -0.5 && r >= -0.5 && c < label.width() - 0.5 && r < label.height() - 0.5;
  }
  /// The label of the cell that contains frame pixel (u, v), which the window must cover.
  SurfaceLabel at(double u, double v) const {
    return label.at(static_cast<int>(std::lround((u - u0) / step_u)), static_cast<int>(std::lround((v - v0) / step_v)));
  }
  /// The hand's log odds interpolated at frame pixel (u, v); outside the window, those at its border.
  float hand_odds_at(double u, double v) const;
};

/// The hand's 21 joints in the usual order of landmarks: wrist; thumb carpometacarpal, metacarpophalangeal,
/// interphalangeal, tip; then index, middle, ring and little finger, each metacarpophalangeal, proximal and distal
/// interphalangeal, tip. A tip is the centre of the end cap, like the distal end of a segment.
inline constexpr int kLandmarkCount = 21;
inline constexpr int kWristLandmark = 0;
inline constexpr int kMiddleKnuckleLandmark = 9;
/// Landmark `k` (0 nearest the wrist, 3 the tip) of a finger (0 the thumb).
constexpr int landmark_of(int finger, int k) { return 1 + 4 * finger + k; }

/// Position of a joint, visible or not, as estimated by the detection. Camera frame.
struct DetectedJoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();        ///< estimated position [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< covariance of the position [m^2]
};

using DetectedJoints = std::array<DetectedJoint, kLandmarkCount>;

/// From these log odds of the side on, either way, the networks tell it: of most hands they are 4 to 20.
inline constexpr double kToldSide = 3;

/// One hand that a detection found. Camera frame, metres.
struct DetectedHand {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< centre of the palm, between wrist and middle knuckle
  /// Probability of a palm from the whole frame's heat map; 1 if the hand was found where tracking predicted it.
  double palm = 0;
  double hand_log_odds = 0;             ///< log odds of a hand in the window against anything else
  double right_log_odds = 0;            ///< log odds of a right hand against a left one
  Handedness side = Handedness::right;  ///< the joints are those of a hand of this side
  DetectedJoints joints;
  /// Its joints if it is a hand of the other side. None, unless both sides are looked for and the networks cannot tell
  /// them apart.
  std::optional<DetectedJoints> other_joints = {};
  LabelMap labels;         ///< labels of a window of about 0.34 m around the hand
  bool skin_only = false;  ///< whether the networks saw only what has the colour of skin

  /// Whether there are joints of a hand of this side.
  bool may_be(Handedness of) const { return of == side || other_joints; }
  /// The joints of a hand of this side if there are any, otherwise those of the other side.
  const DetectedJoints& joints_of(Handedness of) const { return of == side || !other_joints ? joints : *other_joints; }
};

/// Result of the detection networks for one frame. Immutable once shared.
struct Detection {
  /// Whether a hand that is not tracked yet can only be one of `hands`. False if all hands are tracked, because then
  /// only windows around them were searched.
  bool whole_frame = false;
  /// Whether every tracked hand was looked for where it is expected: one that is not in `hands` was not seen there.
  bool around_tracked = false;
  std::vector<DetectedHand> hands;  ///< most probable first; no two at the same place
  /// A tracked hand that was examined again in an earlier frame (stages/detection/second_look.h), moved to where it is
  /// expected now. None in most frames.
  std::optional<DetectedHand> second_look;
};
using DetectionPtr = std::shared_ptr<const Detection>;

}  // namespace barehand
