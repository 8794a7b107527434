#include "drivers/synthetic/hand/skinning.h"

#include "drivers/synthetic/hand/skeleton.h"
#include "tests/synthetic/test_hand.h"

namespace barehand::synthetic {
namespace {

class Skinning : public HandTest {
 protected:
  std::vector<Eigen::Vector3f> deformed(const SkeletonPose& pose) const {
    std::vector<Eigen::Vector3f> vertices;
    Skinner(right_).deform(pose_segments(measure_profile(right_), pose), vertices);
    return vertices;
  }
};

TEST_F(Skinning, AtRestGivesTheRestVertices) {
  const auto vertices = deformed({});
  ASSERT_EQ(vertices.size(), right_.vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) EXPECT_LT((vertices[v] - right_.vertices[v]).norm(), 1e-6f);
}

TEST_F(Skinning, MovesRigidlyWithTheWrist) {
  const SE3 T{exp_so3({0.3, -0.2, 0.5}), {0.1, 0.2, 0.6}};
  const auto vertices = deformed({T, {}});
  for (std::size_t v = 0; v < vertices.size(); ++v)
    EXPECT_LT((vertices[v].cast<double>() - T * right_.vertices[v].cast<double>()).norm(), 1e-6);
}

TEST_F(Skinning, AFlexedFingerTakesItsTipAndLeavesTheOthers) {
  // Bend the index finger.
  SkeletonPose pose;
  pose.angles[1].flexion = {1.0, 0, 0};
  const auto vertices = deformed(pose);
  const Skinner skinner(right_);

  // Its tip moves, that of the ring finger does not.
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const float moved = (vertices[v] - right_.vertices[v]).norm();
    if (skinner.vertex_segments()[v] == segment_of(1, 2)) {
      EXPECT_GT(moved, 0.05f);
      EXPECT_LT(vertices[v].y(), right_.vertices[v].y()) << "flexion must go towards the palm";
    }
    if (skinner.vertex_segments()[v] == segment_of(3, 2)) {
      EXPECT_LT(moved, 1e-6f);
    }
  }
}

TEST_F(Skinning, PositiveAbductionSpreadsTheFingers) {
  const HandProfile profile = measure_profile(right_);
  const auto tip_distance = [&](double abduction) {
    SkeletonPose pose;
    pose.angles[1].abduction = abduction;
    pose.angles[4].abduction = abduction;
    const HandPose hand = pose_segments(profile, pose);
    return (proximal_end(hand, segment_of(1, 2)) - proximal_end(hand, segment_of(4, 2))).norm();
  };
  EXPECT_GT(tip_distance(0.2), tip_distance(0) + 0.02);
}

TEST_F(Skinning, NormalsPointOutwards) {
  std::vector<Eigen::Vector3f> normals;
  vertex_normals(right_.vertices, right_.triangles, normals);
  double volume = 0;
  for (const Triangle& t : right_.triangles)
    volume += right_.vertices[t[0]].cross(right_.vertices[t[1]]).dot(right_.vertices[t[2]]) / 6;
  EXPECT_GT(volume, 2e-4) << "a hand has 0.3 litres";
  for (const auto& n : normals) EXPECT_NEAR(n.norm(), 1, 1e-4);
}

}  // namespace
}  // namespace barehand::synthetic
