#include "drivers/synthetic/hand/animated_hand.h"

#include "drivers/synthetic/hand/hand_mesh_file.h"
#include "drivers/synthetic/hand/hand_mirror.h"
#include "drivers/synthetic/hand/measured_profile.h"
#include "drivers/synthetic/rendering/sleeve.h"

namespace barehand::synthetic {

// A simulated hand: its mesh, posed by joint angles, as triangles in the camera frame.

Result<AnimatedHand> AnimatedHand::load(Handedness side, const HandShape& shape, const std::string& mesh_folder) {
  const auto path = find_hand_mesh(side, mesh_folder);
  if (!path) return tl::unexpected(path.error());
  const auto mesh = load_hand_mesh(*path, side);
  if (!mesh) return tl::unexpected(mesh.error());
  const HandMesh own = reshaped(*mesh, shape);
  return AnimatedHand(side == Handedness::right ? own : mirrored(own), measure_profile(own), shape.scale);
}

AnimatedHand::AnimatedHand(const HandMesh& right, HandProfile profile, double scale)
    : rig_{right, measure_profile(right)}, skinner_(right), profile_(std::move(profile)), scale_(scale) {}

HandPose AnimatedHand::pose(const SkeletonPose& skeleton) const {
  HandPose pose = pose_segments(rig_.profile, skeleton);
  if (side() == Handedness::left)
    for (SE3& T : pose) T = mirrored(T);
  return pose;
}

SceneGeometry AnimatedHand::geometry(const HandState& state, const std::string& sleeve,
                                     std::uint8_t first_surface) const {
  // Deform the skin.
  const HandPose pose = pose_segments(rig_.profile, state.skeleton);
  TriangleMesh skin;
  skin.triangles = rig_.mesh.triangles;
  skinner_.deform(pose, skin.vertices);
  vertex_normals(skin.vertices, skin.triangles, skin.normals);

  // Make one surface of each segment, and one of the sleeve.
  SceneGeometry geometry;
  geometry.add(skin, SE3{}, first_surface);
  for (std::size_t i = 0; i < geometry.surface.size(); ++i) geometry.surface[i] += triangle_segments()[i];
  if (sleeve != "none")
    geometry.add(make_sleeve(pose[kPalm], state.elbow, scale_, sleeve == "skin"), SE3{}, first_surface + kSleeve);
  if (side() == Handedness::left) geometry.mirror();
  return geometry;
}

}  // namespace barehand::synthetic
