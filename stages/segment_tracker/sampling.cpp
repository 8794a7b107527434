// Draws samples of segment poses in the boxes of kernels (paper, Sec. 4.4).
#include "stages/segment_tracker/sampling.h"

#include <cassert>

#include "hand/joint_angles.h"
#include "math/random.h"

namespace barehand {

SE3 draw_sample(const std::vector<Kernel>& kernels, int segment, int index, const SampleKey& key) {
  // Use the centre of each kernel as its first sample.
  assert(!kernels.empty());
  const int count = static_cast<int>(kernels.size());
  const Kernel& kernel = kernels[index % count];
  if (index < count) return kernel.T_camera_segment;

  // Draw the other samples uniformly in the kernel's box.
  const std::uint32_t place = static_cast<std::uint32_t>(segment) | static_cast<std::uint32_t>(key.level) << 8;
  KeyedRandom random(key.seed, key.frame, place, static_cast<std::uint32_t>(index));
  Vector6d offset;
  for (int k = 0; k < 6; ++k) offset[k] = random.uniform(-kernel.half_width[k], kernel.half_width[k]);
  const SE3 inside{joint_rotation({.flexion = offset[3], .abduction = offset[4], .twist = offset[5]}),
                   offset.head<3>()};
  return kernel.T_camera_segment * inside;
}

}  // namespace barehand
