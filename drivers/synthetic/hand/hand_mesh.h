#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "drivers/synthetic/hand/hand_joints.h"
#include "math/se3.h"

namespace barehand::synthetic {

// The rigged mesh of the simulated hand.

using Triangle = std::array<std::uint32_t, 3>;

/// The joints, up to four, that a vertex follows, and its weights, which sum to 1.
struct SkinWeights {
  std::array<std::uint8_t, 4> joint{};
  std::array<float, 4> weight{};
};

/// A rigged hand at rest. Hand frame: origin at the wrist joint, -z towards the fingers, +y dorsal; metres. Coinciding
/// vertices are merged, so that the skin is closed even at the seams of its texture.
struct HandMesh {
  Handedness handedness = Handedness::right;
  std::array<SE3, kJointCount> T_hand_joint;  ///< OpenXR axes: -z along the bone, +y dorsal
  std::vector<Eigen::Vector3f> vertices;
  std::vector<SkinWeights> weights;
  std::vector<Triangle> triangles;

  /// Sum of the weights with which a vertex follows a segment.
  float segment_weight(std::size_t vertex, int segment) const;
  /// The segment of a triangle: the one that its three vertices follow most.
  int segment_of_triangle(const Triangle& triangle) const;
};

/// Reads a glTF hand with OpenXR joint names and axes. The hierarchy of the nodes is ignored: joints are often stored
/// as siblings, and their names define the hierarchy. Errors: an unreadable file, missing joints, axes that are not
/// OpenXR's, a size that no hand in metres has, a hand of the other side.
Result<HandMesh> load_hand_mesh(const std::string& path, Handedness handedness);

}  // namespace barehand::synthetic
