// Changes the shape of a simulated hand's mesh, such as its size and the lengths of its fingers.
#include "drivers/synthetic/hand/hand_shape.h"

namespace barehand::synthetic {
namespace {

/// Scale factors, along the joint's own axes, for the skin and the next joint that follow a joint.
Eigen::Vector3d stretch(int joint, const HandShape& shape) {
  const std::array<double, kFingerCount> length = {shape.thumb, shape.index, shape.middle, shape.ring, shape.little};
  if (segment_of_joint(joint) == kPalm) return shape.scale * Eigen::Vector3d(1, shape.thickness, 1);
  const int finger = joint < 5 ? 0 : joint / 5;
  return shape.scale * Eigen::Vector3d(shape.thickness, shape.thickness, length[finger]);
}

}  // namespace

HandMesh reshaped(const HandMesh& mesh, const HandShape& shape) {
  HandMesh result = mesh;
  std::array<Eigen::Affine3d, kJointCount> deform;  // maps the old to the new skin, both in the hand frame

  // Stretch the bones joint by joint, from the wrist to the tips.
  for (int joint = 0; joint < kJointCount; ++joint) {
    const SE3& T = mesh.T_hand_joint[joint];
    const int parent = parent_of_joint(joint);
    if (parent >= 0) result.T_hand_joint[joint].t = deform[parent] * T.t;  // parents have smaller indices
    deform[joint] = Eigen::Translation3d(result.T_hand_joint[joint].t) *
                    Eigen::Affine3d(Eigen::Matrix3d(T.R * stretch(joint, shape).asDiagonal() * T.R.transpose())) *
                    Eigen::Translation3d(-T.t);
  }

  // Move the skin by its weights.
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i)
      sum += mesh.weights[v].weight[i] * (deform[mesh.weights[v].joint[i]] * mesh.vertices[v].cast<double>());
    result.vertices[v] = sum.cast<float>();
  }
  return result;
}

}  // namespace barehand::synthetic
