#include "benchmarks/world.h"

#include "observe/hand_renderer.h"
#include "stages/preprocess/preprocess.h"
#include "support/adult_hand.h"

namespace barehand::bench {
namespace {

constexpr double kWall = 1.0;  // [m]

FramePtr paint(const Skin& skin, const HandPose& pose) {
  auto frame = std::make_shared<RgbdFrame>();
  frame->camera = {640, 480, 525, 525, 319.5, 239.5};
  frame->depth_unit = 1e-4;
  frame->depth.reset(640, 480, static_cast<std::uint16_t>(kWall / frame->depth_unit));
  frame->colour.reset(640, 480, Rgb{120, 120, 120});
  RenderedHand rendered;
  render_hand(skin, pose, frame->camera, {0, 0, 1, 640, 480}, rendered);
  for (std::size_t i = 0; i < rendered.depth.size(); ++i) {
    if (rendered.depth[i] <= 0) continue;
    frame->depth[i] = static_cast<std::uint16_t>(rendered.depth[i] / frame->depth_unit);
    frame->colour[i] = {205, 150, 120};
  }
  return frame;
}

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
  w.frame = paint(*w.skin, w.pose);
  const HandEstimate before = hint(w);
  w.observation = Preprocessor(w.preprocess).process(w.frame, &before).value();
  return w;
}

}  // namespace

HandEstimate hint(const World& world) {
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
