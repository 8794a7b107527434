#pragma once

#include <memory>

#include "hand/rendering/hand_renderer.h"
#include "sensor/rgbd_frame.h"

namespace barehand::test {

/// The frame of an ideal colour and depth camera that sees a posed skin before a grey wall, which is 1 m away.
inline std::shared_ptr<RgbdFrame> paint_frame(const Skin& skin, const HandPose& pose, const Intrinsics& camera) {
  constexpr double kWall = 1.0;  // distance of the wall [m]
  auto frame = std::make_shared<RgbdFrame>();
  frame->camera = camera;
  frame->depth_unit = 1e-4;
  frame->depth.reset(camera.width, camera.height, static_cast<std::uint16_t>(kWall / frame->depth_unit));
  frame->colour.reset(camera.width, camera.height, Rgb{120, 120, 120});

  // Paint the skin in front of the wall.
  RenderedHand rendered;
  render_hand(skin, pose, camera, {0, 0, 1, camera.width, camera.height}, rendered);
  for (std::size_t i = 0; i < rendered.depth.size(); ++i) {
    if (rendered.depth[i] <= 0) continue;
    frame->depth[i] = static_cast<std::uint16_t>(rendered.depth[i] / frame->depth_unit);
    frame->colour[i] = {205, 150, 120};
  }
  return frame;
}

}  // namespace barehand::test
