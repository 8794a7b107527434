#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "hand/joint_angles.h"
#include "tests/synthetic/small_simulator.h"

namespace barehand::synthetic {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::Gt;
using testing::HasSubstr;
using testing::Le;
using testing::Lt;

constexpr int kRight = 0, kLeft = 1;

SimulatorParams two_hands(const std::string& noise = "none", int seed = 1) {
  SimulatorParams params = small_scene("two_hands");
  params.noise = noise;
  params.seed = seed;
  return params;
}

SimulatedFrame at(Simulator& sim, double time) { return sim.render(std::lround(time * sim.fps())); }

/// Mean visible fraction of a hand's segments.
double shown(const HandTruth& hand) {
  double sum = 0;
  for (const TableRow& row : hand.table->rows) sum += row.visible;
  return sum / kSegmentCount;
}

bool is_fist(const HandTruth& hand) {
  const auto& rows = hand.table->rows;
  return (rows[segment_of(2, 2)].distal - rows[kPalm].proximal).norm() < 0.1;
}

/// Smallest distance between the vertices of two surfaces [m]. Distances above 0.1 m are not exact.
float gap(const SceneGeometry& a, const SceneGeometry& b) {
  Eigen::AlignedBox3f box;
  for (const auto& v : b.vertices) box.extend(v);
  float square = 1;
  for (const auto& v : a.vertices) {
    if (box.squaredExteriorDistance(v) > 0.01f) continue;
    for (const auto& w : b.vertices) square = std::min(square, (v - w).squaredNorm());
  }
  return std::sqrt(square);
}

TEST(TwoHands, AreARightAndALeftOne) {
  Simulator sim = simulator(two_hands());
  ASSERT_EQ(sim.hands().size(), 2u);
  EXPECT_EQ(sim.hands()[kRight].profile().handedness, Handedness::right);
  EXPECT_EQ(sim.hands()[kLeft].profile().handedness, Handedness::left);

  // The truth is the kinematics of each profile.
  const SimulatedFrame frame = at(sim, 9.5);  // both hands are open
  for (int hand : {kRight, kLeft}) {
    const HandProfile& profile = sim.hands()[hand].profile();
    std::array<JointAngles, kSegmentCount> angles{};
    for (int s = 1; s < kSegmentCount; ++s) angles[s] = joint_angles(profile, frame.hands[hand].pose, s);
    const HandPose again = forward_kinematics(profile, frame.hands[hand].pose[kPalm], angles);
    for (int s = 0; s < kSegmentCount; ++s)
      EXPECT_LT((frame.hands[hand].table->rows[s].distal - distal_end(profile, again, s)).norm(), 1e-6);
  }

  // With palms to the camera and fingers up, the right hand's thumb is on the right in the image and the left hand's
  // on the left.
  const auto thumb_side = [&](int hand) {
    const auto& rows = frame.hands[hand].table->rows;
    return rows[segment_of(0, 2)].distal.x() - rows[segment_of(4, 2)].distal.x();
  };
  EXPECT_GT(thumb_side(kRight), 0.05);
  EXPECT_LT(thumb_side(kLeft), -0.05);
}

TEST(TwoHands, ComeAndGoOneByOne) {
  Simulator sim = simulator(two_hands());
  const struct {
    double from, to;
    bool right, left;
  } stretches[] = {{0, 1.2, true, false},    {1.6, 10.0, true, true},   {10.3, 11.1, false, true},
                   {11.5, 11.9, true, true}, {12.2, 12.9, true, false}, {13.4, 13.6, true, true}};
  for (const auto& stretch : stretches)
    for (double time = stretch.from; time < stretch.to; time += 0.1) {
      const SimulatedFrame frame = at(sim, time);
      EXPECT_EQ(frame.hands[kRight].table.has_value(), stretch.right) << time;
      EXPECT_EQ(frame.hands[kLeft].table.has_value(), stretch.left) << time;
    }
}

/// Visibility of the farther hand while two hands cross: its smallest visible fraction, and the time during which more
/// than a tenth of it is hidden [s].
struct Crossing {
  double least_shown = 1, seconds = 0;
};

Crossing cross(double from, double to, int front, int behind) {
  Simulator sim = simulator(two_hands());
  Crossing crossing;
  for (double time = from; time < to; time += 1 / sim.fps()) {
    const SimulatedFrame frame = at(sim, time);
    EXPECT_GT(shown(frame.hands[front]), 0.97) << time;
    EXPECT_THAT(frame.hands[behind].pose[kPalm].t.z() - frame.hands[front].pose[kPalm].t.z(),
                AllOf(Gt(0.08), Lt(0.12)));
    crossing.least_shown = std::min(crossing.least_shown, shown(frame.hands[behind]));
    crossing.seconds += shown(frame.hands[behind]) < 0.9 ? 1 / sim.fps() : 0;
  }
  return crossing;
}

TEST(TwoHands, CrossTwiceEachOnceInFront) {
  for (const Crossing& c : {cross(3.4, 4.9, kRight, kLeft), cross(5.7, 7.2, kLeft, kRight)}) {
    EXPECT_THAT(c.least_shown, AllOf(Ge(0.4), Le(0.6)));
    EXPECT_THAT(c.seconds, AllOf(Ge(0.2), Lt(1.0)));
  }
}

TEST(TwoHands, TheNearerOneIsInThePicture) {
  Simulator sim = simulator(two_hands());
  const SimulatedFrame f = at(sim, 4.13);
  int hidden = 0, seen = 0;

  // The nearer hand is in the depth image wherever the other one is hidden.
  for (const TableRow& row : f.hands[kLeft].table->rows) {
    const Eigen::Vector3d middle = 0.5 * (row.proximal + row.distal);
    const Eigen::Vector2d pixel = sim.camera().project(middle);
    const double in_front =
        middle.z() - f.frame->depth_unit * f.frame->depth.at(static_cast<int>(std::lround(pixel.x())),
                                                             static_cast<int>(std::lround(pixel.y())));

    if (row.visible < 0.05) {
      ++hidden;
      EXPECT_THAT(in_front, AllOf(Gt(0.06), Lt(0.16)));
    } else if (row.visible > 0.95) {
      ++seen;
      EXPECT_THAT(in_front, AllOf(Gt(0.0), Lt(0.02)));
    }
  }
  EXPECT_GE(hidden, 2);
  EXPECT_GE(seen, 2);
}

TEST(TwoHands, NeverTouch) {
  Simulator sim = simulator(two_hands());
  const auto sequence = make_sequence("two_hands", nullptr, 1);
  ASSERT_TRUE(sequence.has_value());

  // Check the gap over time, including the moment when the fists are next to each other.
  for (double time = 0; time < (*sequence)->duration(); time += 0.1) {
    const SceneState state = (*sequence)->at(time);
    const auto geometry = [&](int hand, const std::string& sleeve) {
      return sim.hands()[hand].geometry(state.hands[hand], sleeve, 0);
    };
    EXPECT_GT(gap(geometry(kRight, "blue"), geometry(kLeft, "blue")), 0.015) << time;
    if (time > 8.05 && time < 8.85) {
      EXPECT_NEAR(gap(geometry(kRight, "none"), geometry(kLeft, "none")), 0.05, 0.006) << time;
    }
  }
}

TEST(TwoHands, MeetAsFists) {
  Simulator sim = simulator(two_hands());
  for (const HandTruth& hand : at(sim, 8.4).hands) EXPECT_TRUE(is_fist(hand));
  for (const HandTruth& hand : at(sim, 9.5).hands) EXPECT_FALSE(is_fist(hand));
}

TEST(TwoHands, AreDeterministicInSeedAndFrameNumber) {
  const auto depth = [](const SimulatedFrame& f) {
    return std::vector(f.frame->depth.data(), f.frame->depth.data() + f.frame->depth.size());
  };
  for (const char* noise : {"kinect", "tof"}) {
    Simulator once = simulator(two_hands(noise)), again = simulator(two_hands(noise));
    again.render(250);  // the order of the frames does not matter
    const auto a = once.render(124), b = again.render(124);
    EXPECT_EQ(depth(a), depth(b));
    Simulator other = simulator(two_hands(noise, 2));
    EXPECT_NE(depth(a), depth(other.render(124)));
  }
}

TEST(TwoHands, OfASideIsAnError) {
  SimulatorParams params = two_hands();
  params.hand = "left";
  const auto made = Simulator::create(params);
  ASSERT_FALSE(made.has_value());
  EXPECT_THAT(made.error().message(), AllOf(HasSubstr("two_hands"), HasSubstr("hand=left")));
}

}  // namespace
}  // namespace barehand::synthetic
