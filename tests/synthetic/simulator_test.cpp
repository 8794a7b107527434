
#include <gmock/gmock.h>

#include "hand/joint_angles.h"
#include "tests/synthetic/small_simulator.h"
#include "tests/synthetic/test_hand.h"

namespace barehand::synthetic {
namespace {

SimulatorParams small(const std::string& sequence, const std::string& noise = "none", int seed = 1) {
  SimulatorParams params;
  params.sequence = sequence;
  params.noise = noise;
  params.seed = seed;
  params.width = 320;
  params.height = 240;
  return params;
}

std::vector<std::uint16_t> depth_of(const SimulatedFrame& f) {
  return {f.frame->depth.data(), f.frame->depth.data() + f.frame->depth.size()};
}

TEST(Simulator, TruthIsTheKinematicsOfItsProfile) {
  for (const std::string hand : {"right", "left"}) {
    SimulatorParams params = small("fist");
    params.hand = hand;
    Simulator sim = simulator(params);
    const SimulatedFrame frame = sim.render(30);
    const HandProfile& profile = sim.hands().front().profile();
    EXPECT_EQ(to_string(profile.handedness), hand);

    // The angles of the pose describe a fist.
    std::array<JointAngles, kSegmentCount> angles{};
    for (int s = 1; s < kSegmentCount; ++s) angles[s] = joint_angles(profile, frame.hands.front().pose, s);
    EXPECT_GT(angles[segment_of(2, 0)].flexion, 0.8) << "a fist is flexed, also a left one";

    // Forward kinematics with these angles gives the truth.
    const HandPose again = forward_kinematics(profile, frame.hands.front().pose[kPalm], angles);
    for (int s = 0; s < kSegmentCount; ++s) {
      EXPECT_LT((frame.hands.front().table->rows[s].proximal - again[s].t).norm(), 1e-6);
      EXPECT_LT((frame.hands.front().table->rows[s].distal - distal_end(profile, again, s)).norm(), 1e-6);
    }
  }
}

TEST(Simulator, LeftHandIsTheMirrorImageOfARightOne) {
  SimulatorParams params = small("open");
  Simulator right = simulator(params);
  params.hand = "left";
  Simulator left = simulator(params);
  const auto a = right.render(0), b = left.render(0);
  int differing = 0;
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) differing += std::abs(a.frame->depth.at(u, v) - b.frame->depth.at(319 - u, v)) > 50;
  EXPECT_LT(differing, 200) << "the two meshes of the package differ a little";
}

TEST(Simulator, IsDeterministicInSeedAndFrameNumber) {
  for (const char* noise : {"none", "kinect", "tof"}) {
    Simulator once = simulator(small("grasp_ball", noise)), again = simulator(small("grasp_ball", noise));
    again.render(7);  // the order of the frames does not matter
    const auto a = once.render(60), b = again.render(60);
    EXPECT_EQ(depth_of(a), depth_of(b));
    EXPECT_TRUE(
        std::equal(a.frame->colour.data(), a.frame->colour.data() + a.frame->colour.size(), b.frame->colour.data()));
    Simulator other = simulator(small("grasp_ball", noise, 2));
    EXPECT_NE(depth_of(a), depth_of(other.render(60)));
  }
}

TEST(Simulator, DepthLiesOnTheHandWhereItIsVisible) {
  Simulator sim = simulator(small("open"));
  const SimulatedFrame f = sim.render(0);
  for (int finger = 1; finger < kFingerCount; ++finger) {
    const int s = segment_of(finger, 1);
    const TableRow& row = f.hands.front().table->rows[s];
    ASSERT_GT(row.visible, 0.95);

    // The depth at the middle of a phalanx differs from that of the bone by half of its thickness.
    const Eigen::Vector3d middle = 0.5 * (row.proximal + row.distal);
    const Eigen::Vector2d pixel = sim.camera().project(middle);
    const double z = f.frame->depth_unit * f.frame->depth.at(static_cast<int>(std::lround(pixel.x())),
                                                             static_cast<int>(std::lround(pixel.y())));
    const double thickness = 0.5 * (sim.hands().front().profile().segments[s].half_thickness[0] +
                                    sim.hands().front().profile().segments[s].half_thickness[1]);
    EXPECT_NEAR(middle.z() - z, thickness, 0.003) << kSegmentNames[s];
  }
}

TEST(Simulator, VisibleFractionOfAnOpenHandIsOneAndOfAFistLess) {
  Simulator sim = simulator(small("fist"));
  const auto open = sim.render(0), closed = sim.render(42);
  for (int s = 1; s < kSegmentCount; ++s)
    EXPECT_GT(open.hands.front().table->rows[s].visible, 0.95) << kSegmentNames[s];
  EXPECT_LT(closed.hands.front().table->rows[segment_of(2, 0)].visible, 0.7);
}

TEST(Simulator, FollowsRateAndSpeed) {
  SimulatorParams params = small("fist");
  params.fps = 50;
  Simulator fast = simulator(params);
  EXPECT_EQ(fast.frame_count(), 320);
  params.fps = 25;
  Simulator slow = simulator(params);
  EXPECT_LT((fast.render(60).hands.front().pose[5].t - slow.render(30).hands.front().pose[5].t).norm(), 1e-12);
  EXPECT_EQ(fast.render(50).frame->utime, 2'000'000);
}

TEST(Simulator, ColourIsNeverPureBlack) {
  Simulator sim = simulator(small("grasp_pliers"));
  const auto frame = sim.render(100).frame;
  for (std::size_t i = 0; i < frame->colour.size(); ++i) EXPECT_NE(frame->colour[i], Rgb{});
}

TEST(Simulator, ErrorsSayWhatToDo) {
  const auto unknown = Simulator::create(small("dance"));
  ASSERT_FALSE(unknown.has_value());
  EXPECT_THAT(unknown.error().message(), testing::HasSubstr("grasp_mug"));
  const auto missing = Simulator::create(small("fist"), "/nowhere");
  ASSERT_FALSE(missing.has_value());
  EXPECT_THAT(missing.error().message(), testing::HasSubstr("fetch_hand_mesh.sh"));
}

}  // namespace
}  // namespace barehand::synthetic
