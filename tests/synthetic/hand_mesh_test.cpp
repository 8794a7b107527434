#include "drivers/synthetic/hand/hand_mesh.h"

#include <gmock/gmock.h>

#include <map>

#include "drivers/synthetic/hand/hand_mirror.h"
#include "drivers/synthetic/hand/hand_shape.h"
#include "tests/synthetic/test_hand.h"

namespace barehand::synthetic {
namespace {

TEST(JointNames, OfSeveralConventionsAreUnderstood) {
  EXPECT_EQ(joint_from_name("index-finger-phalanx-proximal"), joint_of(1, 1));
  EXPECT_EQ(joint_from_name("XR_HAND_JOINT_LITTLE_TIP_EXT"), joint_of(4, 4));
  EXPECT_EQ(joint_from_name("pinky_metacarpal_l"), joint_of(4, 0));
  EXPECT_EQ(joint_from_name("Right.Wrist"), kWristJoint);
  EXPECT_EQ(joint_from_name("forearm"), std::nullopt);
}

TEST(JointNames, LeadToTheirSegments) {
  EXPECT_EQ(segment_of_joint(kWristJoint), kPalm);
  EXPECT_EQ(segment_of_joint(joint_of(3, 0)), kPalm);
  for (int s = 0; s < kSegmentCount; ++s) EXPECT_EQ(segment_of_joint(joint_of_segment(s)), s);
  EXPECT_EQ(segment_of_joint(joint_of(0, 3)), segment_of(0, 2));
  EXPECT_EQ(segment_of_joint(joint_of(2, 4)), segment_of(2, 2));
}

class HandMeshFile : public HandTest {};

TEST_F(HandMeshFile, IsAClosedSkinAfterWelding) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : right_.triangles)
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

TEST_F(HandMeshFile, WeightsSumToOne) {
  for (const SkinWeights& w : right_.weights) {
    EXPECT_NEAR(w.weight[0] + w.weight[1] + w.weight[2] + w.weight[3], 1, 1e-5);
  }
}

TEST_F(HandMeshFile, TellsTheOtherHandApart) {
  const auto path = find_hand_mesh(Handedness::right);
  const auto wrong = load_hand_mesh(*path, Handedness::left);
  ASSERT_FALSE(wrong.has_value());
  EXPECT_THAT(wrong.error().message(), testing::HasSubstr("not a left hand"));
}

TEST_F(HandMeshFile, MirroredTwiceIsItself) {
  const HandMesh twice = mirrored(mirrored(right_));
  EXPECT_EQ(twice.vertices, right_.vertices);
  EXPECT_EQ(twice.triangles, right_.triangles);
}

TEST_F(HandMeshFile, ShapeFactorsChangeWhatTheyName) {
  HandShape shape;
  shape.scale = 1.1;
  shape.index = 1.2;
  shape.thickness = 0.9;
  const HandProfile before = measure_profile(right_), after = measure_profile(reshaped(right_, shape));
  const int index = segment_of(1, 1), ring = segment_of(3, 1);
  EXPECT_NEAR(after.segments[index].length / before.segments[index].length, 1.32, 0.01);
  EXPECT_NEAR(after.segments[ring].length / before.segments[ring].length, 1.1, 0.005);
  EXPECT_NEAR(after.segments[ring].half_width[0] / before.segments[ring].half_width[0], 0.99, 0.02);
}

TEST(HandMeshMissing, SaysWhatToRun) {
  const auto path = find_hand_mesh(Handedness::right, "/nowhere");
  ASSERT_FALSE(path.has_value());
  EXPECT_THAT(path.error().message(), testing::HasSubstr("deploy/fetch_hand_mesh.sh"));
}

TEST(HandMeshUnfit, IsAnError) { EXPECT_FALSE(load_hand_mesh("/dev/null", Handedness::right).has_value()); }

}  // namespace
}  // namespace barehand::synthetic
