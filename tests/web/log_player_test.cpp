#include "app/view/log_player.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

using Kind = PlayerCommand::Kind;

constexpr std::int64_t kSecond = 1'000'000;

LogPosition ten_frames() {
  std::vector<double> seconds;
  for (int i = 0; i < 10; ++i) seconds.push_back(0.1 * i);
  return {seconds, {{2, 3}, {7, 8}}};
}

TEST(LogPosition, PlaysAtTheSpeedOfTheLog) {
  LogPosition log = ten_frames();
  EXPECT_TRUE(log.advance(5 * kSecond)) << "the first frame";
  EXPECT_FALSE(log.advance(5 * kSecond + 90'000));
  EXPECT_TRUE(log.advance(5 * kSecond + 110'000));
  EXPECT_EQ(log.frame(), 1);
}

TEST(LogPosition, ShowsEveryFrameThatIsALittleLate) {
  LogPosition log = ten_frames();
  log.advance(0);
  for (const std::int64_t expected : {1, 2, 3}) {
    EXPECT_TRUE(log.advance(310'000));
    EXPECT_EQ(log.frame(), expected);
  }
  EXPECT_FALSE(log.advance(310'000));
  EXPECT_NEAR(static_cast<double>(log.due_us().value()), 400'000, 5) << "it keeps the pace of the log";
}

TEST(LogPosition, LeavesOutFramesWhereItIsFarBehind) {
  LogPosition log = ten_frames();
  log.advance(0);
  for (const std::int64_t expected : {4, 5, 6, 7}) {
    EXPECT_TRUE(log.advance(710'000));
    EXPECT_EQ(log.frame(), expected);
  }
  EXPECT_FALSE(log.advance(710'000));
}

TEST(LogPosition, StopsAtTheEndAndStartsAgain) {
  LogPosition log = ten_frames();
  log.advance(0);
  log.advance(100 * kSecond);
  EXPECT_EQ(log.frame(), 9);
  EXPECT_FALSE(log.state().playing);
  EXPECT_FALSE(log.due_us());
  log.follow({Kind::play, 0}, 200 * kSecond);
  EXPECT_TRUE(log.advance(200 * kSecond));
  EXPECT_EQ(log.frame(), 0);
}

TEST(LogPosition, GoesFasterAndSlower) {
  LogPosition log = ten_frames();
  log.advance(0);
  log.follow({Kind::speed, 4}, 0);
  while (log.advance(101'000)) continue;
  EXPECT_EQ(log.frame(), 4);
  log.follow({Kind::speed, -1}, 0);
  EXPECT_EQ(log.state().speed, 4) << "no speed";
}

TEST(LogPosition, StepsAndSeeksWithinTheLog) {
  LogPosition log = ten_frames();
  log.follow({Kind::seek, 5.2}, 0);
  EXPECT_TRUE(log.advance(0));
  EXPECT_EQ(log.frame(), 5);
  log.follow({Kind::step, -1}, 0);
  EXPECT_EQ(log.frame(), 4);
  EXPECT_FALSE(log.state().playing);
  log.follow({Kind::step, -100}, 0);
  EXPECT_EQ(log.frame(), 0);
  log.follow({Kind::seek, 1e9}, 0);
  EXPECT_EQ(log.frame(), 9);
}

TEST(LogPosition, JumpsToFramesWithoutAHand) {
  LogPosition log = ten_frames();
  for (const std::int64_t wanted : {2, 7, 7}) {
    log.follow({Kind::lost, 1}, 0);
    EXPECT_EQ(log.frame(), wanted);
  }
  log.follow({Kind::lost, -1}, 0);
  EXPECT_EQ(log.frame(), 2);
}

TEST(LogPosition, PassesOverLongPauses) {
  LogPosition log({0, 3600}, {});
  log.advance(0);
  EXPECT_LE(log.due_us().value(), 10 * kSecond);
}

}  // namespace
}  // namespace barehand
