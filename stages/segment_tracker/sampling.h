#pragma once

#include <cstdint>

#include "hand/samples.h"

namespace barehand {

/// What the random numbers of one computation step are keyed by, so that they depend on nothing else.
struct SampleKey {
  std::uint64_t seed = 0;
  std::uint32_t frame = 0;
  int level = 0;   ///< from 0
  int levels = 1;  ///< of the whole hierarchy; no part of the key, says where in the schedules this level stands
};

/// Sample `index` of a segment (Sec. 4.4). Samples are dealt to the kernels in turn; the first of each kernel is its
/// centre, the others uniform in its box: translation along and rotation about the segment's own axes.
SE3 draw_sample(const std::vector<Kernel>& kernels, int segment, int index, const SampleKey& key);

}  // namespace barehand
