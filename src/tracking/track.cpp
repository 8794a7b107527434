// The data that a tracker keeps from frame to frame about its hand.
#include "tracking/track.h"

#include <utility>

namespace barehand {

void Track::continue_with(const Hypothesis& best, const HandProfile& profile, const TrackerParams& params) {
  std::array<bool, kSegmentCount> seen;
  for (int s = 0; s < kSegmentCount; ++s) seen[s] = best.refined.matched[s] >= params.seen_fraction;
  HandPose pose = best.refined.pose;
  // If fingers may be confused, it is not known either where they would touch an object.
  auto holds = best.refined.holds;
  if (is_ambiguous(best.score(), params.choice))
    for (FingerHold& hold : holds) hold.closed.reset();
  if (params.hidden_follow)
    pose = hidden_fingers.follow(profile, motion.pose(), pose, best.prediction->dt, seen, best.refined.matched, holds,
                                 params.initialiser.widening);
  motion.update(pose, seen, *best.prediction);
}

void Track::change(const TrackerParams& params) {
  MotionModel next(params.prediction, params.icp);
  if (motion.has_pose()) next.restart(motion.pose(), motion.utime());
  motion = std::move(next);
  state.change(params.loss);
}

void Track::forget() {
  state.reset();
  motion.forget();
  last_good.reset();
  hidden_fingers.forget();
  search_frames = 0;
  baseline.reset();
  evidence.forget();
}

}  // namespace barehand
