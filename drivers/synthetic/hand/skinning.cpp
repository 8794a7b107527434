// Deforms a hand mesh with its segments by linear blend skinning.
#include "drivers/synthetic/hand/skinning.h"

#include <algorithm>

namespace barehand::synthetic {

Skinner::Skinner(const HandMesh& mesh) : rest_(mesh.vertices), weights_(mesh.weights) {
  for (int s = 0; s < kSegmentCount; ++s) T_segment_hand_[s] = mesh.T_hand_joint[joint_of_segment(s)].inverse();
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    for (auto& joint : weights_[v].joint) joint = static_cast<std::uint8_t>(segment_of_joint(joint));
    int best = 0;
    for (int s = 1; s < kSegmentCount; ++s)
      if (mesh.segment_weight(v, s) > mesh.segment_weight(v, best)) best = s;
    vertex_segments_.push_back(static_cast<std::uint8_t>(best));
  }
  for (const Triangle& t : mesh.triangles)
    triangle_segments_.push_back(static_cast<std::uint8_t>(mesh.segment_of_triangle(t)));
}

void Skinner::deform(const HandPose& pose, std::vector<Eigen::Vector3f>& vertices) const {
  // Compute the motion of every segment from rest to the pose.
  std::array<Eigen::Matrix<float, 3, 4>, kSegmentCount> move;
  for (int s = 0; s < kSegmentCount; ++s) {
    const SE3 T = pose[s] * T_segment_hand_[s];
    move[s] << T.R.cast<float>(), T.t.cast<float>();
  }

  // Blend these motions at every vertex.
  vertices.resize(rest_.size());
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    const Eigen::Vector4f p = rest_[v].homogeneous();
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (int i = 0; i < 4; ++i) sum += weights_[v].weight[i] * (move[weights_[v].joint[i]] * p);
    vertices[v] = sum;
  }
}

void vertex_normals(const std::vector<Eigen::Vector3f>& vertices, const std::vector<Triangle>& triangles,
                    std::vector<Eigen::Vector3f>& normals) {
  normals.assign(vertices.size(), Eigen::Vector3f::Zero());
  for (const Triangle& t : triangles) {
    const Eigen::Vector3f n = (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]);
    for (const std::uint32_t v : t) normals[v] += n;
  }
  for (auto& n : normals) n /= std::max(n.norm(), 1e-20f);
}

}  // namespace barehand::synthetic
