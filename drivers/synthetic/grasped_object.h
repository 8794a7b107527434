#pragma once

#include <array>
#include <span>
#include <string>

#include "drivers/synthetic/rendering/scene_geometry.h"
#include "hand/segments.h"
#include "math/mesh_distance.h"
#include "math/se3.h"

namespace barehand::synthetic {

/// How near one segment of a hand is to a grasped object.
struct SegmentContact {
  double distance = 0;  ///< smallest signed distance of the segment's skin from the object [m]; negative inside
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< place on the object that is nearest to that skin, camera frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outward unit normal of the object there, camera frame
};
using HandContacts = std::array<SegmentContact, kSegmentCount>;

/// The state of a grasped object in one frame.
struct ObjectTruth {
  SE3 T_camera_object;
  bool held = false;  ///< moves with the hand
};

/// The object that a hand grasps, as it is rendered: for a left hand it is the mirror image, in the plane x = 0 of its
/// own frame, of the object that the sequence was made with.
class GraspedObject {
 public:
  GraspedObject(std::string name, TriangleMesh mesh);

  const std::string& name() const { return name_; }
  const TriangleMesh& mesh() const { return mesh_; }
  /// The distance of every segment's skin. Skin is sampled at its vertices, so that it may be up to about 0.1 mm nearer
  /// between them; the distance of a vertex is exact. `skin`: vertices in the camera frame; `segments`: of every
  /// vertex.
  HandContacts contacts(std::span<const Eigen::Vector3f> skin, std::span<const std::uint8_t> segments,
                        const SE3& T_camera_object) const;

 private:
  std::string name_;
  TriangleMesh mesh_;
  MeshDistance distance_;
};

}  // namespace barehand::synthetic
