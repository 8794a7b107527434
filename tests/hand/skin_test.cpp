#include "hand/skin.h"

#include <algorithm>
#include <map>

#include "support/adult_hand.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

class SkinTest : public ::testing::Test {
 protected:
  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  Skin skin_ = make_blended_skin(*profile_, 0.004);
};

TEST_F(SkinTest, BindsEveryVertexToAdjacentSegmentsOnly) {
  for (const SkinVertex& v : skin_.vertices) {
    EXPECT_GE(v.weight_b, 0);
    EXPECT_LE(v.weight_b, 0.5f);
    EXPECT_TRUE(v.a == v.b || parent_of(v.a) == v.b || parent_of(v.b) == v.a) << v.a << " " << v.b;
  }
}

TEST_F(SkinTest, IsEmptyIfItsMakingIsStopped) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(make_blended_skin(*profile_, 0.004, stop.get_token()).vertices.empty());
  EXPECT_EQ(make_blended_skin(*profile_, 0.004, std::stop_source().get_token()).vertices.size(), skin_.vertices.size());
}

TEST_F(SkinTest, FingertipsEndOneRadiusBeyondTheTipJoint) {
  const HandPose pose = test::facing_pose(*profile_, 0.5, 0.0);
  std::vector<Vector3f> posed;
  pose_skin(skin_, pose, posed);
  for (int finger = 0; finger < kFingerCount; ++finger) {
    const int tip = segment_of(finger, 2);
    const SegmentProfile& s = profile_->segments[tip];
    double reach = 0;
    for (std::size_t i = 0; i < posed.size(); ++i)
      if (skin_.vertices[i].a == tip) reach = std::max(reach, -(pose[tip].inverse() * posed[i].cast<double>()).z());
    EXPECT_NEAR(reach, s.length + s.radius[1], 0.0015) << finger;
  }
}

TEST_F(SkinTest, FollowsARigidMotionOfTheWholeHand) {
  const HandPose pose = test::facing_pose(*profile_, 0.5, 0.6);
  const SE3 motion{exp_so3({0.3, -0.8, 0.2}), {0.02, -0.1, 0.3}};
  HandPose moved = pose;
  for (SE3& T : moved) T = motion * T;
  std::vector<Vector3f> before, after;
  pose_skin(skin_, pose, before);
  pose_skin(skin_, moved, after);
  for (std::size_t i = 0; i < before.size(); i += 37)
    EXPECT_LT((motion * before[i].cast<double>() - after[i].cast<double>()).norm(), 1e-5);
}

TEST_F(SkinTest, ThicknessFollowsTheProfile) {
  // Half way along the middle finger's second phalanx, the skin is as wide as the profile's sections.
  const int s = segment_of(2, 1);
  const SegmentProfile& segment = profile_->segments[s];
  double widest = 0;
  for (const SkinVertex& v : skin_.vertices)
    if (v.a == s && std::abs(-v.in_a.z() - 0.5 * segment.length) < 0.004)
      widest = std::max<double>(widest, std::abs(v.in_a.x()));
  EXPECT_NEAR(widest, 0.5 * (segment.half_width[0] + segment.half_width[1]), 0.001);
}

/// Counts the edges that do not belong to one triangle in each direction: those at the border of an open surface.
int open_edges(const Skin& skin) {
  std::map<std::pair<int, int>, int> balance;
  for (const auto& t : skin.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return static_cast<int>(std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

TEST_F(SkinTest, ACoarserOneHasFewerTrianglesAndNoNewHoles) {
  const Skin coarse = coarsened(skin_, 0.006);
  EXPECT_LT(coarse.triangles.size(), 0.5 * skin_.triangles.size());
  Skin torn = skin_;
  torn.triangles.pop_back();
  ASSERT_GT(open_edges(torn), open_edges(skin_));
  EXPECT_LE(open_edges(coarse), open_edges(skin_));
  EXPECT_EQ(coarsened(skin_, 1e-6).triangles, skin_.triangles) << "too small a cell joins nothing";
}

TEST_F(SkinTest, ACoarserOneLiesWhereTheFineOneDoes) {
  const Skin coarse = coarsened(skin_, 0.006);
  const HandPose pose = test::facing_pose(*profile_, 0.5, 0.3);
  std::vector<Vector3f> fine_posed, coarse_posed;
  pose_skin(skin_, pose, fine_posed);
  pose_skin(coarse, pose, coarse_posed);
  for (std::size_t i = 0; i < fine_posed.size(); ++i) {
    float nearest = 1;
    for (std::size_t k = 0; k < coarse_posed.size(); ++k)
      if (coarse.vertices[k].a == skin_.vertices[i].a)
        nearest = std::min(nearest, (coarse_posed[k] - fine_posed[i]).norm());
    EXPECT_LT(nearest, 0.009f);
  }
}

TEST_F(SkinTest, SurfacePointsCarryTheWholeArea) {
  const HandSurface few = surface_points(skin_, *profile_, 20), many = surface_points(skin_, *profile_, 100000);
  for (int s = 0; s < kSegmentCount; ++s) {
    const auto total = [](const SegmentSurface& part) {
      double sum = 0;
      for (float a : part.area) sum += a;
      return sum;
    };
    EXPECT_LE(few[s].size(), 20u);
    EXPECT_GT(few[s].size(), 10u);
    EXPECT_NEAR(total(few[s]), total(many[s]), 1e-3 * total(many[s])) << s;
  }
}

TEST_F(SkinTest, AScannedSkinGoesBeforeTheSections) {
  HandProfile scanned = *profile_;
  scanned.scanned_skin = std::make_shared<const Skin>(scaled(skin_, 1.1));
  EXPECT_EQ(make_skin(scanned, 0.004).vertices[7].in_a, scanned.scanned_skin->vertices[7].in_a);
  EXPECT_EQ(make_skin(*profile_, 0.004).vertices[7].in_a, skin_.vertices[7].in_a);
}

TEST_F(SkinTest, AScannedSkinIsMirroredAndScaledWithItsHand) {
  // The hand and its mirrored, enlarged copy at rest.
  HandProfile hand = *profile_;
  hand.scanned_skin = std::make_shared<const Skin>(skin_);
  HandProfile other = scaled(mirrored(hand), 1.2);
  std::vector<Vector3f> posed, posed_other;
  HandPose rest, rest_other;
  for (int s = 0; s < kSegmentCount; ++s) {
    rest[s] = hand.segments[s].T_hand_segment;
    rest_other[s] = other.segments[s].T_hand_segment;
  }

  // Their skins correspond.
  pose_skin(skin_, rest, posed);
  pose_skin(*other.scanned_skin, rest_other, posed_other);
  for (std::size_t i = 0; i < posed.size(); ++i)
    ASSERT_LT((posed_other[i] - 1.2f * posed[i].cwiseProduct(Vector3f(-1, 1, 1))).norm(), 1e-5f) << i;

  // Triangles still face outward: normals computed from them agree with those that were mirrored.
  Skin anew = *other.scanned_skin;
  compute_normals(other, anew);
  double agree = 0;
  for (std::size_t i = 0; i < anew.vertices.size(); ++i)
    agree += anew.vertices[i].normal_in_a.dot(other.scanned_skin->vertices[i].normal_in_a);
  EXPECT_GT(agree / static_cast<double>(anew.vertices.size()), 0.95);
}

}  // namespace
}  // namespace barehand
