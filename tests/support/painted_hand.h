#pragma once

#include <memory>

#include "hand/rendering/hand_renderer.h"
#include "observe/dense/nearest_cell.h"
#include "observe/observation.h"
#include "support/adult_hand.h"

namespace barehand::test {

inline Intrinsics small_camera() { return {320, 240, 262.0, 262.0, 159.5, 119.5}; }

/// For every pixel, the index of the nearest marked pixel (value 0 or more); -1: no pixel is marked.
inline Image<std::int32_t> nearest_in(const Image<std::int32_t>& marked) {
  NearestCell nearest;
  nearest.index(marked);
  Image<std::int32_t> result(marked.width(), marked.height(), -1);
  for (int v = 0; v < marked.height(); ++v)
    for (int u = 0; u < marked.width(); ++u) result.at(u, v) = nearest.find(u, v);
  return result;
}

/// The observation of an ideal camera that sees a posed skin in front of a wall at `wall` [m]; the whole image is the
/// region of interest. Use it for unit tests of single stages only: accuracy is measured on hands that the tracker does
/// not know.
inline std::shared_ptr<HandObservation> observe_skin(const Skin& skin, const HandPose& pose, double wall = 1.2) {
  // Render the skin.
  const Intrinsics camera = small_camera();
  auto frame = std::make_shared<RgbdFrame>();
  frame->camera = camera;
  RenderedHand rendered;
  render_hand(skin, pose, camera, {0, 0, 1, camera.width, camera.height}, rendered);

  // Fill in the observation: the wall, then the hand's pixels.
  auto observation = std::make_shared<HandObservation>();
  observation->frame = frame;
  observation->hand_present = true;
  observation->depth.reset(camera.width, camera.height, static_cast<float>(wall));
  observation->label.reset(camera.width, camera.height, PixelLabel::background);
  observation->normal.reset(camera.width, camera.height, Eigen::Vector3f::Zero());

  for (std::size_t i = 0; i < rendered.vertex.size(); ++i) {
    if (rendered.vertex[i] < 0) continue;
    observation->depth[i] = rendered.depth[i];
    observation->label[i] = PixelLabel::hand;
    observation->normal[i] = rendered.normal[rendered.vertex[i]];
    observation->hand_pixels.push_back(static_cast<std::int32_t>(i));
  }

  // Add the distance transform and a thinned point cloud.
  observation->nearest_hand = nearest_in(rendered.vertex);
  for (std::size_t i = 0; i < observation->hand_pixels.size(); i += 7)
    observation->cloud.push_back(observation->point(observation->hand_pixels[i]));
  return observation;
}

/// A copy of an observation with another time stamp [us].
inline std::shared_ptr<HandObservation> stamped(const HandObservation& observation, std::int64_t utime) {
  auto frame = observation.frame ? std::make_shared<RgbdFrame>(*observation.frame) : std::make_shared<RgbdFrame>();
  frame->utime = utime;
  auto copy = std::make_shared<HandObservation>(observation);
  copy->frame = frame;
  return copy;
}

}  // namespace barehand::test
