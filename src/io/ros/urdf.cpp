// Writes a hand profile as a robot description (URDF).
#include "io/ros/urdf.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "core/format.h"
#include "hand/joint_angles.h"

namespace barehand::ros {
namespace {

/// The element `<origin>`. URDF gives a rotation as angles about the fixed axes x, y and z, in this order.
std::string origin(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  const double roll = std::atan2(R(2, 1), R(2, 2)), yaw = std::atan2(R(1, 0), R(0, 0));
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2)));
  return formatted("<origin xyz=\"%.9g %.9g %.9g\" rpy=\"%.9g %.9g %.9g\"/>", t.x(), t.y(), t.z(), roll, pitch, yaw);
}

std::string visual(const std::string& place, const std::string& shape) {
  return "    <visual>" + place + "<geometry>" + shape + "</geometry></visual>\n";
}

/// The shape of a segment: a box for the palm, otherwise a cylinder around the bone with a sphere at either end.
std::string shape_of(const SegmentProfile& segment, bool palm) {
  const Eigen::Vector3d bone = segment.distal;
  const Eigen::Matrix3d R = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), bone).toRotationMatrix();
  const std::string middle = origin(R, bone / 2);
  if (palm)
    return visual(middle, formatted("<box size=\"%.6g %.6g %.6g\"/>", segment.half_width[0] + segment.half_width[1],
                                    segment.half_thickness[0] + segment.half_thickness[1], bone.norm()));
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const double radius = (segment.radius[0] + segment.radius[1]) / 2;
  return visual(middle, formatted("<cylinder radius=\"%.6g\" length=\"%.6g\"/>", radius, bone.norm())) +
         visual(origin(I, Eigen::Vector3d::Zero()), formatted("<sphere radius=\"%.6g\"/>", segment.radius[0])) +
         visual(origin(I, bone), formatted("<sphere radius=\"%.6g\"/>", segment.radius[1]));
}

/// A hinge: its name, the links that it joins, its `<origin>` in the parent link, its axis and its range [rad].
struct Hinge {
  std::string name, parent, child, place;
  const char* axis;
  double lower, upper;
};

std::string joint(const Hinge& hinge) {
  return "  <joint name=\"" + hinge.name + "\" type=\"revolute\">\n    <parent link=\"" + hinge.parent +
         "\"/><child link=\"" + hinge.child + "\"/>\n    " + hinge.place + "<axis xyz=\"" + hinge.axis + "\"/>" +
         formatted("<limit lower=\"%.6g\" upper=\"%.6g\" effort=\"0\" velocity=\"0\"/>\n", hinge.lower, hinge.upper) +
         "  </joint>\n";
}

/// The name of the joint at which a segment begins, such as "index_pip", as in glove_state_t.
std::string joint_name(int segment) {
  constexpr std::array kFingers = {"thumb", "index", "middle", "ring", "little"};
  constexpr std::array kOfThumb = {"_cmc", "_mcp", "_ip"}, kOfFinger = {"_mcp", "_pip", "_dip"};
  const auto finger = static_cast<std::size_t>(finger_of(segment)), k = static_cast<std::size_t>((segment - 1) % 3);
  return kFingers[finger] + std::string(finger == 0 ? kOfThumb[k] : kOfFinger[k]);
}

/// Whether the joint at which a segment begins can also abduct.
bool has_abduction(int segment) { return (segment - 1) % 3 == 0 || segment == segment_of(0, 1); }

}  // namespace

std::string urdf(const HandProfile& profile) {
  // The names and the direction of abduction depend on the side of the hand.
  const std::string side(to_string(profile.handedness)), prefix = side + "_";
  const double towards_thumb =
      side_sign(profile.handedness);  // 1 if a rotation about +y leads towards the thumb, or -1
  const auto limits = widened_limits(profile, 0);
  const auto link_name = [&](int s) { return prefix + std::string(kSegmentNames[static_cast<std::size_t>(s)]); };

  // Write a link for each segment, and the joints that connect it to its parent.
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"" + side + "_hand\">\n";
  for (int s = 0; s < kSegmentCount; ++s) {
    text += "  <link name=\"" + link_name(s) + "\">\n" +
            shape_of(profile.segments[static_cast<std::size_t>(s)], s == kPalm) + "  </link>\n";
    if (s == kPalm) continue;

    // The hinge of abduction comes first, then that of flexion about the axis turned by it.
    const SE3 rest = profile.rest_relative(s);
    const JointLimits& range = limits[static_cast<std::size_t>(s)];
    Hinge flexion{prefix + joint_name(s) + "_flex",
                  link_name(parent_of(s)),
                  link_name(s),
                  origin(rest.R, rest.t),
                  "-1 0 0",
                  range.flexion_lo,
                  range.flexion_hi};

    // A joint with abduction gets a link without a shape between its two hinges.
    if (has_abduction(s)) {
      const double a = towards_thumb * range.abduction_lo, b = towards_thumb * range.abduction_hi;
      const std::string between = link_name(s) + "_abd";
      text += "  <link name=\"" + between + "\"/>\n";
      text += joint({prefix + joint_name(s) + "_abd", flexion.parent, between, flexion.place,
                     towards_thumb > 0 ? "0 1 0" : "0 -1 0", std::min(a, b), std::max(a, b)});
      flexion.parent = between;
      flexion.place = origin(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
    }

    // The hinge of flexion moves the segment itself.
    text += joint(flexion);
  }
  return text + "</robot>\n";
}

}  // namespace barehand::ros
