#include "io/hand/pose_json.h"

#include <gmock/gmock.h>

#include "hand/joint_angles.h"
#include "math/angles.h"
#include "support/small_hand.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using test::small_hand;
using testing::HasSubstr;

constexpr const char* kPalmAt = R"("palm": {"T_camera_segment": [[1,0,0,0.1],[0,-1,0,0.05],[0,0,-1,0.5],[0,0,0,1]]})";

class PoseJson : public testing::Test {
 protected:
  Result<HandPose> load(const std::string& segments) {
    test::write_text(path_, "{\"segments\": {" + segments + "}}");
    return load_pose(path_, small_hand());
  }
  test::TempFolder folder_;
  std::string path_ = folder_ / "pose.json";
};

TEST_F(PoseJson, PalmAloneGivesTheOpenHand) {
  const auto pose = load(kPalmAt);
  ASSERT_TRUE(pose) << pose.error().message();
  const HandPose open = forward_kinematics(small_hand(), (*pose)[kPalm], {});
  for (int s = 0; s < kSegmentCount; ++s) EXPECT_TRUE((*pose)[s].matrix().isApprox(open[s].matrix(), 1e-12));
  EXPECT_TRUE((*pose)[kPalm].t.isApprox(Eigen::Vector3d(0.1, 0.05, 0.5)));
}

TEST_F(PoseJson, AnglesBendFromRestAndCarryTheFingerAlong) {
  const auto pose = load(std::string(kPalmAt) + R"(, "index_proximal": {"flexion_deg": 30, "abduction_deg": -10})");
  ASSERT_TRUE(pose) << pose.error().message();
  const JointAngles knuckle = joint_angles(small_hand(), *pose, 4);
  EXPECT_NEAR(knuckle.flexion, 30 * kDegree, 1e-9);
  EXPECT_NEAR(knuckle.abduction, -10 * kDegree, 1e-9);
  EXPECT_NEAR((joint_in_parent(small_hand(), *pose, 5) - proximal_end(*pose, 5)).norm(), 0, 1e-12);
}

TEST_F(PoseJson, SavedPoseComesBack) {
  std::array<JointAngles, kSegmentCount> angles{};
  for (int s = 1; s < kSegmentCount; ++s) angles[s] = {0.05 * s, 0.01 * s, 0.02};
  const HandPose pose = forward_kinematics(small_hand(), SE3{exp_so3({1, 2, 0.5}), {0, 0.1, 0.6}}, angles);
  ASSERT_TRUE(save_pose(pose, path_));
  const auto loaded = load_pose(path_, small_hand());
  ASSERT_TRUE(loaded) << loaded.error().message();
  for (int s = 0; s < kSegmentCount; ++s) EXPECT_TRUE((*loaded)[s].matrix().isApprox(pose[s].matrix(), 1e-8));
}

TEST_F(PoseJson, BadInputIsNamed) {
  EXPECT_THAT(load("").error().message(), HasSubstr("segment palm: \"T_camera_segment\" is missing"));
  EXPECT_THAT(load(std::string(kPalmAt) + R"(, "toe": {})").error().message(), HasSubstr("\"toe\" is not a segment"));
  EXPECT_THAT(load(std::string(kPalmAt) + R"(, "ring_distal": {"flexion_deg": "much"})").error().message(),
              HasSubstr("segment ring_distal: \"flexion_deg\""));
  test::write_text(path_, "[]");
  EXPECT_THAT(load_pose(path_, small_hand()).error().message(), HasSubstr("\"segments\" is missing"));
}

}  // namespace
}  // namespace barehand
