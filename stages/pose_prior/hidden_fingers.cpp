// Infers the poses of hidden fingers from those of their neighbours.
#include "stages/pose_prior/hidden_fingers.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace barehand {
namespace {

using Seen = std::array<bool, kSegmentCount>;

constexpr double kSliver = 0.3;      // a segment with a smaller visible fraction does not show how a grasp closes
constexpr double kWellShown = 0.4;   // visible fraction from which on a segment shows its finger's abduction
constexpr double kThumbShare = 0.5;  // bending of the fingers as a fraction of that of the thumb's two joints together

// Time constants [s]: with which the difference from the neighbours decays, usually and for kReleased [s] after a
// release; with which a held finger closes; and with which abduction is learnt and returns to what was learnt.
constexpr double kMemory = 1.5, kReleasing = 0.1, kReleased = 0.5, kClosing = 0.15, kLearned = 0.5, kReturning = 0.5;

/// Share of a difference that decays within `dt`.
double share_within(double dt, double time_constant) { return 1 - std::exp(-dt / time_constant); }

/// Mean of `value(s)` over the corresponding segments (the same phalanx as `segment`) of the nearest fingers in which
/// that phalanx is seen; none if there are none, and for the thumb, which moves on its own.
template <class Value>
std::optional<double> of_nearest_seen(int segment, const Seen& seen, const Value& value) {
  const int finger = finger_of(segment), k = segment - segment_of(finger, 0);
  if (finger == 0) return std::nullopt;

  // Visit the neighbours in order of their distance.
  for (int away = 1; away < kFingerCount; ++away) {
    double sum = 0;
    int count = 0;
    for (const int other : {finger - away, finger + away}) {
      if (other < 1 || other >= kFingerCount || !seen[segment_of(other, k)]) continue;
      sum += value(segment_of(other, k));
      ++count;
    }

    if (count > 0) return sum / count;
  }
  return std::nullopt;
}

bool hidden_to_its_tip(int segment, const Seen& seen) {
  for (int s = segment;; ++s) {
    if (seen[s]) return false;
    if (is_tip(s)) return true;
  }
}

}  // namespace

HandPose with_hidden_neutral(const HandProfile& profile, const HandPose& pose, const Seen& seen) {
  HandPose result = pose;
  const auto flexion_of = [&](int s) { return std::max(0.0, joint_angles(profile, pose, s).flexion); };
  for (int s = 1; s < kSegmentCount; ++s) {
    if (seen[s]) continue;
    const int parent = parent_of(s);
    const double flexion = parent == kPalm ? of_nearest_seen(s, seen, flexion_of).value_or(0.0)
                                           : std::max(0.0, joint_angles(profile, result, parent).flexion);
    place_segment(profile, s, {is_tip(s) ? kDistalShare * flexion : flexion, 0, 0}, result);
  }
  return result;
}

void HiddenFingers::remember(const HandProfile& profile, const HandPose& now, double dt,
                             const std::array<double, kSegmentCount>& shown,
                             const std::array<FingerHold, kFingerCount>& holds) {
  const double newest = share_within(dt, kLearned);
  for (int f = 1; f < kFingerCount; ++f) {
    Finger& finger = fingers_[f];
    finger.since_held = holds[f].firm() ? 0 : finger.since_held + dt;
    const int root = segment_of(f, 0);
    if (shown[root] < kWellShown) continue;
    const double abduction = joint_angles(profile, now, root).abduction;
    finger.abduction = finger.abduction ? *finger.abduction + newest * (abduction - *finger.abduction) : abduction;
  }
}

HandPose HiddenFingers::follow(const HandProfile& profile, const HandPose& before, const HandPose& now, double dt,
                               const Seen& seen, const std::array<double, kSegmentCount>& shown,
                               const std::array<FingerHold, kFingerCount>& holds, double widening) {
  remember(profile, now, dt, shown, holds);
  const auto limits = widened_limits(profile, widening);

  // Measure how far each joint is bent, and how far it has bent since the previous frame.
  const auto flexion_of = [&](int s) { return joint_angles(profile, now, s).flexion; };
  const auto bent = [&](int s) { return flexion_of(s) - joint_angles(profile, before, s).flexion; };

  // If only the thumb is seen, find how far the fingers bend with it.
  const int thumb_middle = segment_of(0, 1), thumb_tip = segment_of(0, 2);
  const bool only_thumb =
      seen[thumb_middle] && seen[thumb_tip] &&
      std::all_of(shown.begin() + segment_of(1, 0), shown.end(), [](double x) { return x < kSliver; });
  const double with_thumb = only_thumb ? kThumbShare * (bent(thumb_middle) + bent(thumb_tip)) : 0;

  // Move the hidden joints from the palm to the tips.
  HandPose result = now;
  for (int s = segment_of(1, 0); s < kSegmentCount; ++s) {
    if (!hidden_to_its_tip(s, seen)) continue;
    const Finger& finger = fingers_[finger_of(s)];
    const FingerHold& hold = holds[finger_of(s)];
    JointAngles angles = joint_angles(profile, now, s);

    if (hold.closed) {
      const double closed = (*hold.closed)[s - segment_of(finger_of(s), 0)];
      angles.flexion += share_within(dt, kClosing) * (closed - angles.flexion);
    } else if (!hold.firm()) {
      // Bend the joint like its seen neighbours, and let it approach their flexion.
      double aim = angles.flexion + of_nearest_seen(s, seen, bent).value_or(is_tip(s) ? with_thumb / 2 : with_thumb);
      const double approached = share_within(dt, finger.since_held < kReleased ? kReleasing : kMemory);
      aim += approached * (of_nearest_seen(s, seen, flexion_of).value_or(aim) - aim);
      angles.flexion = std::clamp(aim, limits[s].flexion_lo, limits[s].flexion_hi);
    }

    // Let it return to the abduction that was seen.
    const int parent = parent_of(s);
    if (parent == kPalm && finger.abduction)
      angles.abduction += share_within(dt, kReturning) * (*finger.abduction - angles.abduction);
    result[s] = result[parent] * (now[parent].inverse() * now[s]);
    result[s].R = result[parent].R * profile.rest_relative(s).R * joint_rotation(angles);
  }
  return result;
}

}  // namespace barehand
