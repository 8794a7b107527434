#pragma once

#include <cstdint>

#include "hand/samples.h"

namespace barehand {

/// The key of the random numbers of one search level in one frame. The random numbers of a sample depend only on this
/// key, its segment and its index, not on the order in which samples are drawn.
struct SampleKey {
  std::uint64_t seed = 0;
  std::uint32_t frame = 0;
  int level = 0;   ///< from 0
  int levels = 1;  ///< number of levels; not part of the key, but it places `level` in the schedules
};

/// Draws sample `index` of a segment (paper, Sec. 4.4). Samples are assigned to the kernels in turn. The first sample
/// of each kernel is its centre; the others are uniform in its box, with translations along and rotations about the
/// segment's own axes.
SE3 draw_sample(const std::vector<Kernel>& kernels, int segment, int index, const SampleKey& key);

}  // namespace barehand
