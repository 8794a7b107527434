// The data that a tracker keeps from frame to frame about its hand.
#include "tracking/track.h"

#include <algorithm>
#include <utility>

#include "stages/pose_prior/hidden_fingers.h"

namespace barehand {
namespace {

constexpr double kRests = 0.5;  // hidden fingers that rest more firmly on what the hand grips stay where they are

}  // namespace

void Track::continue_with(const Hypothesis& best, const HandProfile& profile, const TrackerParams& params) {
  std::array<bool, kSegmentCount> seen;
  for (int s = 0; s < kSegmentCount; ++s) seen[s] = best.refined.matched[s] >= params.seen_fraction;
  HandPose pose = best.refined.pose;
  if (params.hidden_follow) {
    std::array<bool, kFingerCount> stays;
    std::ranges::transform(best.refined.rests, stays.begin(), [](double firmly) { return firmly > kRests; });
    pose = with_hidden_following(profile, motion.pose(), pose, best.prediction->dt, seen, best.refined.matched, stays,
                                 params.initialiser.widening);
  }
  motion.update(pose, seen, *best.prediction);
}

void Track::change(const TrackerParams& params) {
  MotionModel next(params.prediction, params.icp);
  if (motion.has_pose()) next.restart(motion.pose(), motion.utime());
  motion = std::move(next);
  const bool followed = state.phase() == TrackPhase::tracking || state.phase() == TrackPhase::holding;
  state = TrackState(params.loss);
  if (followed) state.start_tracking();
}

void Track::forget() {
  state.reset();
  motion.forget();
  last_good.reset();
  search_frames = 0;
  baseline.reset();
  evidence.forget();
}

}  // namespace barehand
