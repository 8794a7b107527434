// Sequences in which a plate hides a part of the fingers.
#include <algorithm>

#include "drivers/synthetic/hand/skinning.h"
#include "drivers/synthetic/rendering/shapes.h"
#include "drivers/synthetic/rendering/stage_set.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

constexpr double kOccluderDepth = 0.45;  // distance of the plate [m]; that of the hand is 0.58 m

/// y / z of a point in the camera frame, which determines its row in the image.
double slope_of(const Vector3d& p) { return p.y() / p.z(); }

/// The rows in the image (as y / z) between which the joined fingers (index to little) lie: from the topmost skin to
/// the lowest knuckle.
std::pair<double, double> finger_extent(const HandRig& rig, const SkeletonPose& skeleton) {
  const HandPose pose = pose_segments(rig.profile, skeleton);
  const Skinner skinner(rig.mesh);
  std::vector<Eigen::Vector3f> skin;
  skinner.deform(pose, skin);
  double top = 1e9, bottom = -1e9;
  for (const auto& v : skin) top = std::min(top, slope_of(v.cast<double>()));
  for (int finger = 1; finger < kFingerCount; ++finger)
    bottom = std::max(bottom, slope_of(proximal_end(pose, segment_of(finger, 0))));
  return {top, bottom};
}

}  // namespace

/// The motion of the paper's Fig. 6b, c: the fingers spread and rejoin behind a plate that covers the upper part of the
/// image, down to a fraction of the fingers' length.
std::unique_ptr<Sequence> make_occlusion(const HandRig& rig, int degree, std::uint64_t seed) {
  // List the keyframes of the hand.
  const Vector3d here(0.0, 0.09, 0.58), still(0.1, 0, 0);
  FreeSequence::Setting s;
  s.duration = 1.8;
  s.seed = seed;
  s.keys = {{0.0, here, still, open_joined()},
            {0.1, here, still, open_joined()},
            {0.9, here, still, open_spread()},
            {1.7, here, still, open_joined()}};

  // Compute the plate's lower edge (y / z) for this degree of occlusion. With the margin, degree 0 leaves the hand
  // fully visible, and degree 6 covers the fingers fully.
  const auto [top, bottom] = finger_extent(rig, HandTrack(s.base, s.keys).at(0));
  const double margin = 0.02;
  const double edge = (top - margin) + degree / 6.0 * (bottom - top + 2 * margin);

  SceneObject plate{"occluder", make_plate({-0.17, -0.25, 0}, {0.34, 0, 0}, {0, 0.25, 0}), {{62, 118, 88}}};
  s.objects = {plate};
  s.T_camera_object = {SE3{exp_so3({0, 0.15, 0.06}), {0.01, edge * kOccluderDepth, kOccluderDepth}}};
  return std::make_unique<FreeSequence>(std::move(s));
}

}  // namespace barehand::synthetic
