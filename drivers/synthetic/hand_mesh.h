#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "drivers/synthetic/hand_joints.h"
#include "math/se3.h"

namespace barehand::synthetic {

using Triangle = std::array<std::uint32_t, 3>;

/// Up to four joints that a vertex follows; weights sum to 1.
struct SkinWeights {
  std::array<std::uint8_t, 4> joint{};
  std::array<float, 4> weight{};
};

/// A rigged hand at rest. Hand frame: origin at the wrist joint, -z towards the fingers, +y dorsal; metres.
/// Vertices that coincide are one vertex, so that the skin is closed where its texture has seams.
struct HandMesh {
  Handedness handedness = Handedness::right;
  std::array<SE3, kJointCount> T_hand_joint;  ///< OpenXR axes: -z along the bone, +y dorsal
  std::vector<Eigen::Vector3f> vertices;
  std::vector<SkinWeights> weights;
  std::vector<Triangle> triangles;

  /// Sum of the weights by which a vertex follows a segment.
  float segment_weight(std::size_t vertex, int segment) const;
  /// The segment that a triangle belongs to: the one its three vertices follow most.
  int segment_of_triangle(const Triangle& triangle) const;
};

/// Reads a glTF hand with OpenXR joint names and axes. The nodes' hierarchy is not used: joints are often stored as
/// flat siblings, and their names say what follows what. Errors: unreadable file, missing joints, axes that are not
/// OpenXR's, a size that no hand in metres has, the other hand.
Result<HandMesh> load_hand_mesh(const std::string& path, Handedness handedness);

}  // namespace barehand::synthetic
