#include "benchmarks/world.h"

#include "stages/preprocess/preprocess.h"
#include "support/adult_hand.h"
#include "support/painted_frame.h"

namespace barehand::bench {
namespace {

HandPose beside(const HandPose& pose) {
  HandPose moved;
  for (int s = 0; s < kSegmentCount; ++s)
    moved[s] = boxplus(pose[s], (Vector6d() << 0.003, 0, 0, 0.05, 0, 0).finished());
  return moved;
}

World make_world() {
  World w;
  w.profile = test::adult_hand();
  w.skin = std::make_shared<const Skin>(make_blended_skin(*w.profile, w.tracker.skin_cell));
  w.surface = std::make_shared<const HandSurface>(surface_points(*w.skin, *w.profile, w.tracker.skin_points));
  w.pose = test::facing_pose(*w.profile, 0.5, 0.5);
  w.predicted = beside(w.pose);
  w.frame = test::paint_frame(*w.skin, w.pose, {640, 480, 525, 525, 319.5, 239.5});
  w.observation = Preprocessor(w.preprocess).process(w.frame, feedback(w)).value().front();
  return w;
}

}  // namespace

HandEstimates feedback(const World& world) { return {std::make_shared<HandEstimate>(earlier_estimate(world))}; }

HandEstimate earlier_estimate(const World& world) {
  HandEstimate estimate;
  estimate.status = TrackStatus::tracking;
  estimate.profile = world.profile;
  for (int s = 0; s < kSegmentCount; ++s) estimate.segments[s].T_camera_segment = world.predicted[s];
  return estimate;
}

const World& world() {
  static const World made = make_world();
  return made;
}

}  // namespace barehand::bench
