#pragma once

#include <memory>

#include "hand/surface.h"
#include "math/random.h"
#include "observe/sampled/observer.h"
#include "support/scene.h"

namespace barehand {

/// A batch as one level compares it, with random pixels of every label, and samples around the middle of the image.
struct RandomBatch {
  std::shared_ptr<const HandSurface> surface;
  PixelMap map;
  std::array<std::vector<SE3>, kSegmentCount> poses;

  SampleBatch batch(std::uint64_t map_id = 1, int first_segment = 0) const {
    return {surface, map, map_id, poses, first_segment};
  }
};

inline ScenePixel random_pixel(KeyedRandom& random) {
  const float z = static_cast<float>(random.uniform(0.37, 0.42));
  const double kind = random.uniform();
  if (kind < 0.4) return {z, PixelLabel::hand};
  if (kind < 0.6) return {z, PixelLabel::object};
  if (kind < 0.8) return {kind < 0.7 ? 1.0f : z, PixelLabel::background};
  return {0, PixelLabel::unknown};
}

inline RandomBatch random_batch(std::uint64_t seed, int samples, int skin_points = 83) {
  KeyedRandom random(seed, 1);
  Workers workers(1);
  RandomBatch world;

  // Make a hand, and an image of random pixels.
  world.surface = std::make_shared<HandSurface>(make_cylinder_surface(capsule_profile(), skin_points));
  world.map =
      make_pixel_map(make_observation(small_camera(), [&](int, int) { return random_pixel(random); }), false, workers);
  for (std::int32_t& hidden : world.map.hidden) hidden = random.uniform() < 0.1 ? 0x5a5a : 0;

  // Draw random poses of every segment.
  for (auto& poses : world.poses)
    for (int i = 0; i < samples; ++i) {
      Vector6d step;
      for (int k = 0; k < 6; ++k) step[k] = random.uniform(-1, 1) * (k < 3 ? 0.03 : 1.0);
      poses.push_back(boxplus(upright_pose(), step));
    }
  return world;
}

}  // namespace barehand
