#pragma once

#include <vector>

#include "drivers/synthetic/hand/hand_mesh.h"
#include "hand/hand_pose.h"

namespace barehand::synthetic {

/// Deforms a hand mesh with its segments by linear blend skinning. The object holds everything that does not depend on
/// the pose.
class Skinner {
 public:
  explicit Skinner(const HandMesh& mesh);
  /// Computes the vertices in the frame in which `pose` is given, in the order of the mesh.
  void deform(const HandPose& pose, std::vector<Eigen::Vector3f>& vertices) const;
  /// Segment of every triangle of the mesh.
  const std::vector<std::uint8_t>& triangle_segments() const { return triangle_segments_; }
  /// The segment that each vertex follows most.
  const std::vector<std::uint8_t>& vertex_segments() const { return vertex_segments_; }

 private:
  std::vector<Eigen::Vector3f> rest_;
  std::vector<SkinWeights> weights_;  // weights of segments: `joint` contains indices of segments here
  std::array<SE3, kSegmentCount> T_segment_hand_;
  std::vector<std::uint8_t> triangle_segments_, vertex_segments_;
};

/// Area-weighted vertex normals of a closed surface, which point outward for counter-clockwise triangles.
void vertex_normals(const std::vector<Eigen::Vector3f>& vertices, const std::vector<Triangle>& triangles,
                    std::vector<Eigen::Vector3f>& normals);

}  // namespace barehand::synthetic
