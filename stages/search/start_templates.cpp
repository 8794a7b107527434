// The hand shapes that a search tries, and the orientation that belongs to given angles.
#include "stages/search/start_templates.h"

#include <algorithm>

#include "math/angles.h"

namespace barehand {

namespace {

/// A hand shape: flexion of the three joints of every finger and of the thumb, and spread of the fingers away from the
/// middle one [degrees].
struct Curl {
  std::string_view name;
  std::array<double, 3> finger, thumb;
  double spread;
};
constexpr std::array<Curl, 6> kCurls = {{
    {"open", {3, 5, 3}, {0, 5, 5}, 0},
    {"spread", {0, 5, 3}, {-5, 0, 0}, 12},
    {"half_open", {25, 35, 20}, {5, 10, 10}, 3},
    {"relaxed_curl", {40, 60, 35}, {10, 15, 20}, 0},
    {"grasp", {30, 45, 30}, {20, 20, 25}, 10},
    {"loose_fist", {70, 90, 50}, {20, 30, 35}, 0},
}};

}  // namespace

std::vector<ShapeTemplate> shape_templates(const HandProfile& profile,
                                           const std::array<JointLimits, kSegmentCount>& limits) {
  // On a right hand, a positive rotation about the segment's y axis (abduction) moves a finger towards the thumb.
  const double thumbwards = side_sign(profile.handedness);
  constexpr std::array<double, kFingerCount> kFan = {0, 1, 0, -0.7, -1.4};  // abduction as a factor on the spread
  std::vector<ShapeTemplate> templates;

  // Make one template for each curl of the fingers.
  for (const Curl& curl : kCurls) {
    ShapeTemplate shape{curl.name, {}};
    for (int finger = 0; finger < kFingerCount; ++finger) {
      for (int k = 0; k < 3; ++k)
        shape.angles[segment_of(finger, k)].flexion = kDegree * (finger == 0 ? curl.thumb[k] : curl.finger[k]);
      shape.angles[segment_of(finger, 0)].abduction = kDegree * thumbwards * kFan[finger] * curl.spread;
    }

    // Keep within the limits of this person's joints.
    clamp_angles(shape.angles, limits);
    templates.push_back(shape);
  }
  return templates;
}

Eigen::Matrix3d palm_orientation(double roll, double pitch, double in_plane) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  Eigen::Matrix3d upright;  // palm to the camera, fingers up: x = -x_camera, y = z_camera, z = y_camera
  upright << -1, 0, 0, 0, 0, 1, 0, 1, 0;
  return (AngleAxisd(in_plane, Vector3d::UnitZ()) * AngleAxisd(-pitch, Vector3d::UnitX()) *
          AngleAxisd(roll, Vector3d::UnitY()))
             .toRotationMatrix() *
         upright;
}

}  // namespace barehand
