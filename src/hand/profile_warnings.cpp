#include "hand/profile_warnings.h"

#include <cmath>

#include "core/format.h"
#include "math/angles.h"

namespace barehand {
namespace {

// Finds unlikely values in a hand profile and their probable cause.

// Shortest and longest plausible hand, from the wrist joint to the tip of the middle finger [m]: a two-year-old child's
// and the largest adults', with a margin.
constexpr double kSmallest = 0.1, kLargest = 0.25;
// Largest gap between a joint and the end of its parent bone that needs no warning [m].
constexpr double kGap = 0.0005;
// Largest possible joint limit (half a turn) if radians were read as degrees: pi, rounded up.
constexpr double kRadians = 3.2 * kDegree;

}  // namespace

std::vector<std::string> profile_warnings(const HandProfile& profile) {
  std::vector<std::string> warnings;

  // Warn of an implausible length, as from numbers in millimetres.
  const double length = profile.hand_length();
  if (length < kSmallest || length > kLargest)
    warnings.push_back(
        formatted("the hand is %.0f mm long from wrist to fingertip, people's are from 100 to 250 mm: are its "
                  "lengths right, and in metres?",
                  1e3 * length));

  // Find the largest gap between a joint and the distal end of its parent bone. Joints on the palm are left out, since
  // they need not lie at its distal end.
  double widest = kGap;
  int at = -1;
  for (int s = 0; s < kSegmentCount; ++s) {
    if (s == kPalm || parent_of(s) == kPalm) continue;
    const double gap = (profile.rest_relative(s).t - profile.segments[parent_of(s)].distal).norm();
    if (gap <= widest) continue;
    widest = gap;
    at = s;
  }

  // Warn of a gap that is wider than rounding explains.
  if (at >= 0)
    warnings.push_back(
        formatted("the joint of %s lies %.1f mm from the end of the bone before it: are the numbers of "
                  "\"rest_transform\" rounded? Six decimals are exact enough",
                  kSegmentNames[at].data(), 1e3 * widest));
  return warnings;
}

bool limits_look_like_radians(const HandProfile& profile) {
  int joints = 0, stiff = 0;
  for (const SegmentProfile& segment : profile.segments) {
    for (const JointDof& dof : segment.dofs) {
      if (dof.upper <= dof.lower) continue;  // a fixed joint
      ++joints;
      stiff += std::abs(dof.lower) <= kRadians && std::abs(dof.upper) <= kRadians;
    }
  }
  return 2 * stiff > joints;
}

}  // namespace barehand
