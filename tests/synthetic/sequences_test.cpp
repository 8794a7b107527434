#include <gtest/gtest.h>

#include "tests/synthetic/small_simulator.h"
#include "tests/synthetic/test_hand.h"

namespace barehand::synthetic {
namespace {

class EverySequence : public testing::TestWithParam<std::string> {};

TEST_P(EverySequence, KeepsTheHandInViewAndMovesNoFasterThanAHand) {
  Simulator sim = simulator(small_scene(GetParam()));
  const Intrinsics& camera = sim.camera();
  const bool far = GetParam() == "person" || GetParam() == "desk" || GetParam() == "egocentric";
  std::vector<HandTruth> before;
  for (std::int64_t i = 0; i < sim.frame_count(); ++i) {
    // No segment moves faster than a hand can.
    const SimulatedFrame frame = sim.render(i);
    for (std::size_t hand = 0; hand < before.size(); ++hand)
      for (int s = 0; s < kSegmentCount; ++s)
        EXPECT_LT((frame.hands[hand].pose[s].t - before[hand].pose[s].t).norm() * sim.fps(), 2.0) << "m/s, frame " << i;
    before = frame.hands;

    // The hand stays in the image and within the sensor's range.
    if (frame.hands.empty() || GetParam() == "wave" || GetParam() == "returns" || GetParam() == "two_hands") continue;
    ASSERT_TRUE(frame.hands.front().table.has_value());
    for (const TableRow& row : frame.hands.front().table->rows)
      for (const Eigen::Vector3d& end : {row.proximal, row.distal}) {
        const Eigen::Vector2d pixel = camera.project(end);
        EXPECT_TRUE(pixel.x() > 3 && pixel.x() < camera.width - 3 && pixel.y() > 3 && pixel.y() < camera.height - 3)
            << "frame " << i << ": " << pixel.transpose();
        EXPECT_GT(end.z(), 0.3);
        EXPECT_LT(end.z(), far ? 1.2 : 0.8);
      }
  }
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const SequenceInfo& info : sequence_list()) list.push_back(info.name);
  return list;
}
INSTANTIATE_TEST_SUITE_P(All, EverySequence, testing::ValuesIn(names()), [](const auto& info) { return info.param; });

TEST(Wave, LeavesTheViewAndComesBack) {
  Simulator sim = simulator(small_scene("wave"));
  std::string presence;
  for (std::int64_t i = 0; i < sim.frame_count(); i += 10) presence += sim.render(i).hands.front().table ? 'x' : '.';
  EXPECT_EQ(presence.front(), 'x');
  EXPECT_EQ(presence.back(), 'x');
  EXPECT_NE(presence.find("..."), std::string::npos);
  EXPECT_EQ(presence.find_last_of('.') - presence.find('.'), std::count(presence.begin(), presence.end(), '.') - 1);
}

TEST(Returns, LeavesTheViewTenTimes) {
  Simulator sim = simulator(small_scene("returns"));
  int departures = 0;
  bool was_there = true;
  for (std::int64_t i = 0; i + 1 < sim.frame_count(); ++i) {  // after the last frames the hand does not return
    const bool there = sim.render(i).hands.front().table.has_value();
    departures += was_there && !there;
    was_there = there;
  }
  EXPECT_TRUE(sim.render(0).hands.front().table);
  EXPECT_GE(departures, 10);
}

TEST(Fist, ClosesTwice) {
  Simulator sim = simulator(small_scene("fist"));
  EXPECT_EQ(sim.frame_count(), 160);
  EXPECT_EQ(sim.fps(), 25);
  int closings = 0;
  bool was_closed = false;
  for (std::int64_t i = 0; i < sim.frame_count(); ++i) {
    const TableFrame truth = *sim.render(i).hands.front().table;
    const bool closed = (truth.rows[segment_of(2, 2)].distal - truth.rows[kPalm].proximal).norm() < 0.1;
    closings += closed && !was_closed;
    was_closed = closed;
  }
  EXPECT_EQ(closings, 2);
}

double fingers_visible(int degree) {
  Simulator sim = simulator(small_scene("occlusion_" + std::to_string(degree)));
  const TableFrame truth = *sim.render(0).hands.front().table;
  double sum = 0;
  for (int s = segment_of(1, 0); s < kSegmentCount; ++s) sum += truth.rows[s].visible;
  return sum / 12;
}

TEST(Occlusion, HidesTheFingersByDegrees) {
  EXPECT_GT(fingers_visible(0), 0.97);
  EXPECT_NEAR(fingers_visible(3), 0.5, 0.2);
  EXPECT_LT(fingers_visible(6), 0.02);
  for (int degree = 1; degree <= 6; ++degree) EXPECT_LT(fingers_visible(degree), fingers_visible(degree - 1));
}

}  // namespace
}  // namespace barehand::synthetic
