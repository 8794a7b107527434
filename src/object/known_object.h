#pragma once

#include <memory>
#include <span>
#include <vector>

#include "math/se3.h"
#include "object/distance_grid.h"
#include "object/object_mesh.h"

namespace barehand {

/// A place on the surface of an object with the outward unit normal, in the object's frame [m].
struct SurfaceSample {
  Eigen::Vector3f p, n;
};

/// An object whose shape is known, or was guessed. Immutable once made.
struct KnownObject {
  std::string name;
  std::int32_t id = 0;                 ///< its ObjectEstimate::id
  DistanceGrid grid;                   ///< signed distances
  std::vector<SurfaceSample> samples;  ///< spread evenly over the surface, in random order
  Eigen::Vector3d centre;              ///< centre of the bounding box
  Eigen::Vector3d extent;              ///< size of the bounding box [m]
  double radius = 0;                   ///< all of the surface is within this distance of the centre [m]
  /// The turns that change little of what shows of it, T_object_object: those of half_turns() of its mesh, and about an
  /// axis around which only a part of the surface is not round, such as the handle of a mug, all that are multiples of
  /// 30 degrees.
  std::vector<SE3> turns;
};
using KnownObjectPtr = std::shared_ptr<const KnownObject>;

/// Prepares a closed mesh for tracking, which takes about a second, and 13 with 500,000 triangles. The frame of the
/// object is that of the mesh.
KnownObjectPtr make_known_object(const ObjectMesh& mesh, std::int32_t id);

/// The fraction of the samples that a motion moves farther than `distance` [m] away from the surface.
double moved_share(const DistanceGrid& grid, std::span<const SurfaceSample> samples, const SE3& T_object_object,
                   double distance);

/// Samples spread evenly over the surface of a mesh, in random order; the same for every call.
std::vector<SurfaceSample> sample_surface(const ObjectMesh& mesh);

/// Where an object is in one frame.
struct PosedObject {
  KnownObjectPtr object;
  SE3 T_camera_object;
  Matrix6d covariance = Matrix6d::Identity();  ///< covariance of the boxplus twist (translation, rotation)
  std::int32_t hand_id = -1;                   ///< the hand that holds it; -1: none
};

/// Where an object was in an earlier frame, for the tracker of a hand near it.
struct NearbyObject {
  KnownObjectPtr object;
  SE3 T_base_object;            ///< base: the palm with which the object moves, or the camera if it moves with none
  std::int32_t hand_id = -1;    ///< the hand of that palm; -1: the base is the camera
  std::int32_t holder_id = -1;  ///< the hand that holds it, also if it moves with no palm; -1: none
  double deviation = 0;         ///< standard deviation of its place [m]

  /// T_camera_object, given the pose of the hand's palm.
  SE3 pose(const SE3& T_camera_palm) const { return hand_id >= 0 ? T_camera_palm * T_base_object : T_base_object; }
};

}  // namespace barehand
