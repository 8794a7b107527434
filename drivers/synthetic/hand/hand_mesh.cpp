#include "drivers/synthetic/hand/hand_mesh.h"

namespace barehand::synthetic {

float HandMesh::segment_weight(std::size_t vertex, int segment) const {
  float sum = 0;
  for (int i = 0; i < 4; ++i)
    if (segment_of_joint(weights[vertex].joint[i]) == segment) sum += weights[vertex].weight[i];
  return sum;
}

int HandMesh::segment_of_triangle(const Triangle& triangle) const {
  std::array<float, kSegmentCount> sum{};
  for (const std::uint32_t vertex : triangle)
    for (int i = 0; i < 4; ++i) sum[segment_of_joint(weights[vertex].joint[i])] += weights[vertex].weight[i];
  int best = 0;
  for (int s = 1; s < kSegmentCount; ++s)
    if (sum[s] > sum[best]) best = s;
  return best;
}

}  // namespace barehand::synthetic
