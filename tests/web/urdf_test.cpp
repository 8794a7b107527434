#include "io/ros/urdf.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <map>
#include <regex>

#include "hand/joint_angles.h"
#include "io/hand/hand_json.h"
#include "stages/publish/glove_angles.h"

namespace barehand::ros {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

Vector3d vector(const std::string& text) {
  std::istringstream in(text);
  Vector3d v;
  in >> v.x() >> v.y() >> v.z();
  return v;
}

struct Joint {
  std::string parent, child;
  SE3 place;
  Vector3d axis;
  double lower = 0, upper = 0;
};

/// The joints of a robot, by name.
std::map<std::string, Joint> joints_of(const std::string& text) {
  static const std::regex kJoint(
      "<joint name=\"([^\"]+)\" type=\"revolute\">\\s*<parent link=\"([^\"]+)\"/><child link=\"([^\"]+)\"/>\\s*"
      "<origin xyz=\"([^\"]+)\" rpy=\"([^\"]+)\"/><axis xyz=\"([^\"]+)\"/><limit lower=\"([^\"]+)\" "
      "upper=\"([^\"]+)\"");
  std::map<std::string, Joint> joints;
  for (std::sregex_iterator at(text.begin(), text.end(), kJoint), end; at != end; ++at) {
    const std::smatch& m = *at;
    const Vector3d rpy = vector(m[5]);
    Joint& joint = joints[m[1]];
    joint.parent = m[2];
    joint.child = m[3];
    joint.place.t = vector(m[4]);
    joint.place.R = (AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                     AngleAxisd(rpy.x(), Vector3d::UnitX()))
                        .toRotationMatrix();
    joint.axis = vector(m[6]);
    joint.lower = std::stod(m[7]);
    joint.upper = std::stod(m[8]);
  }
  return joints;
}

class Urdf : public testing::TestWithParam<const char*> {
 protected:
  HandProfile profile_ = load_profile(std::string(BAREHAND_CONFIGS) + "/hands/adult_" + GetParam() + ".json").value();
  std::string side_ = GetParam();
};
INSTANTIATE_TEST_SUITE_P(Sides, Urdf, testing::Values("right", "left"), [](const auto& side) { return side.param; });

TEST_P(Urdf, HasTheJointsOfTheJointStates) {
  const auto joints = joints_of(urdf(profile_));
  EXPECT_EQ(joints.size(), kGloveJointNames.size());
  for (const std::string_view name : kGloveJointNames) {
    const auto found = joints.find(side_ + "_" + std::string(name));
    ASSERT_NE(found, joints.end()) << name;
    EXPECT_LT(found->second.lower, found->second.upper) << name;
  }
}

/// A program that sets the joints to the published angles gets the published pose.
TEST_P(Urdf, MovesAsTheHandDoes) {
  std::array<JointAngles, kSegmentCount> angles;
  for (int s = 1; s < kSegmentCount; ++s) {
    angles[static_cast<std::size_t>(s)].flexion = 0.1 + 0.05 * s;
    const bool sideways = (s - 1) % 3 == 0 || s == 2;
    angles[static_cast<std::size_t>(s)].abduction = sideways ? 0.2 - 0.03 * s : 0;
  }
  const HandPose pose = forward_kinematics(profile_, SE3(), angles);
  const GloveAngles glove = glove_angles(profile_, pose);

  const auto joints = joints_of(urdf(profile_));
  std::map<std::string, std::pair<std::string, SE3>> parent_of_link;
  for (std::size_t i = 0; i < kGloveJointNames.size(); ++i) {
    const Joint& joint = joints.at(side_ + "_" + std::string(kGloveJointNames[i]));
    SE3 turn;
    turn.R = AngleAxisd(glove.joint[i], joint.axis).toRotationMatrix();
    parent_of_link[joint.child] = {joint.parent, joint.place * turn};
  }
  for (int s = 1; s < kSegmentCount; ++s) {
    SE3 T_palm_link;
    for (std::string link = side_ + "_" + std::string(kSegmentNames[static_cast<std::size_t>(s)]);
         link != side_ + "_palm"; link = parent_of_link.at(link).first)
      T_palm_link = parent_of_link.at(link).second * T_palm_link;
    EXPECT_NEAR((T_palm_link.t - pose[s].t).norm(), 0, 1e-6) << kSegmentNames[static_cast<std::size_t>(s)];
    EXPECT_NEAR((T_palm_link.R - pose[s].R).norm(), 0, 1e-6) << kSegmentNames[static_cast<std::size_t>(s)];
  }
}

}  // namespace
}  // namespace barehand::ros
