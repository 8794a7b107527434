#include "drivers/synthetic/grasped_object.h"

#include <gtest/gtest.h>

#include "drivers/synthetic/hand/hand_mirror.h"
#include "drivers/synthetic/rendering/shapes.h"
#include "tests/synthetic/small_simulator.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

/// The ball of `grasp_ball`, which is made of flat faces: they lie up to 0.05 mm inside the sphere.
constexpr double kBallRadius = 0.0325, kFacets = 6e-5;

TEST(GraspedObject, MeasuresEverySegmentsNearestSkin) {
  const GraspedObject ball("ball", make_sphere(kBallRadius));
  const SE3 T_camera_object{Eigen::Matrix3d::Identity(), {0.1, 0, 0.5}};

  // The palm has two vertices, one of them inside; the others are far.
  std::vector<Eigen::Vector3f> skin = {{0.1f, 0, 0.55f}, {0.13f, 0, 0.5f}};
  std::vector<std::uint8_t> segments = {kPalm, kPalm};
  for (int s = 1; s < kSegmentCount; ++s) {
    skin.emplace_back(0.1f, 0.1f, 0.5f);
    segments.push_back(static_cast<std::uint8_t>(s));
  }
  const HandContacts contacts = ball.contacts(skin, segments, T_camera_object);
  EXPECT_NEAR(contacts[kPalm].distance, 0.03 - kBallRadius, kFacets);
  EXPECT_NEAR((contacts[kPalm].point - Vector3d(0.1 + kBallRadius, 0, 0.5)).norm(), 0, 2e-4);
  EXPECT_NEAR((contacts[kPalm].normal - Vector3d::UnitX()).norm(), 0, 0.01);
  EXPECT_NEAR(contacts[5].distance, 0.1 - kBallRadius, kFacets);
  EXPECT_NEAR((contacts[5].normal - Vector3d::UnitY()).norm(), 0, 0.01);
}

/// The frame in the middle of a grasp, when the object is held.
SimulatedFrame held_frame(Simulator& simulator) { return simulator.render(110); }

TEST(GraspedObject, IsTouchedWhileItIsHeldAndFarBefore) {
  for (const char* name : {"grasp_mug", "grasp_ball", "grasp_pliers"}) {
    Simulator simulated = simulator(small_scene(name));
    const SimulatedFrame before = simulated.render(0), held = held_frame(simulated);
    ASSERT_TRUE(before.object && held.object) << name;
    EXPECT_FALSE(before.object->held);
    EXPECT_TRUE(held.object->held);

    // Count the segments that touch the object.
    const HandContacts far = *simulated.contacts(before, 0), near = *simulated.contacts(held, 0);
    int touching = 0;
    for (int s = 0; s < kSegmentCount; ++s) {
      EXPECT_GT(far[s].distance, 0.02) << name << " " << kSegmentNames[s];
      const SegmentContact& contact = near[s];
      touching += contact.distance < 0.002;
      EXPECT_GT(contact.distance, -0.006) << name << " " << kSegmentNames[s];
      EXPECT_NEAR(contact.normal.norm(), 1, 1e-6);
    }
    EXPECT_GE(touching, 4) << name;
  }
}

TEST(GraspedObject, PlaceNormalAndDistanceAgreeWithTheBall) {
  for (const char* hand : {"right", "left"}) {
    SimulatorParams params = small_scene("grasp_ball");
    params.hand = hand;
    Simulator simulated = simulator(params);
    const SimulatedFrame frame = held_frame(simulated);
    const HandContacts contacts = *simulated.contacts(frame, 0);
    for (const SegmentContact& contact : contacts) {
      const Vector3d from_centre = contact.point - frame.object->T_camera_object.t;
      EXPECT_NEAR(from_centre.norm(), kBallRadius, kFacets) << hand;
      EXPECT_NEAR((from_centre.normalized() - contact.normal).norm(), 0, 0.01) << hand;
    }
  }
}

TEST(GraspedObject, OfALeftHandIsTheMirrorImage) {
  Simulator right = simulator(small_scene("grasp_mug"));
  SimulatorParams params = small_scene("grasp_mug");
  params.hand = "left";
  Simulator left = simulator(params);
  const SimulatedFrame r = held_frame(right), l = held_frame(left);

  // Every vertex of the mesh is in the mirrored place, but for the difference between the meshes of the two hands.
  const auto& mesh = right.grasped()->mesh();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector3d place = r.object->T_camera_object * mesh.vertices[v].cast<double>();
    const Vector3d other = l.object->T_camera_object * left.grasped()->mesh().vertices[v].cast<double>();
    ASSERT_LT((mirrored(place) - other).norm(), 0.001);
  }
  EXPECT_NEAR(l.object->T_camera_object.R.determinant(), 1, 1e-9);

  // So are the contacts.
  const HandContacts of_right = *right.contacts(r, 0), of_left = *left.contacts(l, 0);
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentContact &a = of_right[s], &b = of_left[s];
    EXPECT_NEAR(a.distance, b.distance, 0.002) << kSegmentNames[s];
    EXPECT_LT((mirrored(a.normal) - b.normal).norm(), 0.1) << kSegmentNames[s];
  }
}

TEST(GraspedObject, IsAbsentWhereNothingIsGrasped) {
  Simulator simulated = simulator(small_scene("desk"));
  const SimulatedFrame frame = simulated.render(0);
  EXPECT_EQ(simulated.grasped(), nullptr);
  EXPECT_FALSE(frame.object);
  EXPECT_FALSE(simulated.contacts(frame, 0));
}

}  // namespace
}  // namespace barehand::synthetic
