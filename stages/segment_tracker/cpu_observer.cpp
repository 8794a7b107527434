// Compares samples of segment poses with the depth image on the CPU.
#include "stages/segment_tracker/cpu_observer.h"

#include <algorithm>
#include <limits>

#include "stages/segment_tracker/patch_distance.h"

namespace barehand {

float distance_cap(const SegmentTrackerParams& params) {
  return params.pixel_distance_cap > 0 ? static_cast<float>(params.pixel_distance_cap)
                                       : std::numeric_limits<float>::infinity();
}

void CpuObserver::compare(const SampleBatch& batch, PatchDistances& distances) {
  const int first = batch.first_segment, count = static_cast<int>(batch.poses[first].size());
  const int chunks = (count + kSampleChunk - 1) / kSampleChunk;
  for (auto& of_segment : distances) of_segment.assign(count, {});
  workers_.for_each_index((kSegmentCount - first) * chunks, [&](int task) {
    const int s = first + task / chunks, begin = task % chunks * kSampleChunk;
    for (int i = begin; i < std::min(begin + kSampleChunk, count); ++i)
      distances[s][i] = patch_distance((*batch.surface)[s], batch.poses[s][i], s, batch.map, cap_);
  });
}

}  // namespace barehand
