#include "io/lcm/message_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "drivers/lcm/wire.h"
#include "io/lcm/lcm_log_writer.h"
#include "io/mcap/mcap_scene.h"
#include "mcap/mcap_bytes.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000;

/// The messages of a hand with recognisable numbers.
ros::HandState hand(int frame) {
  ros::HandState hand{};
  hand.state.utime = hand.glove.utime = hand.joints.utime = kStart + 33'000 * frame;
  hand.state.frame_number = hand.glove.frame_number = hand.joints.frame_number = frame;
  hand.state.segments[3].covariance[2][2] = 0.1 + frame;
  hand.glove.channel[7] = 0.2 + frame;
  hand.joints.radius[25] = 0.3 + frame;
  return hand;
}

class MessageLogTest : public testing::Test {
 protected:
  /// The same three frames in both formats.
  MessageLogTest() {
    auto lcm = LcmLogWriter::create(lcm_, false);
    auto file = mcap::McapWriter::create(mcap_, false);
    EXPECT_TRUE(lcm && file);
    for (int frame = 0; frame < 3; ++frame) {
      const ros::HandState one = hand(frame);
      const std::int64_t utime = one.state.utime;
      EXPECT_TRUE((*lcm)->send("HAND_STATE", encode_message(one.state), utime));
      EXPECT_TRUE((*lcm)->send("GLOVE_STATE", encode_message(one.glove), utime));
      EXPECT_TRUE((*lcm)->send("HAND_JOINTS", encode_message(one.joints), utime));
      ros::Scene scene;
      scene.utime = utime;
      scene.number = frame;
      scene.hands = {one};
      EXPECT_TRUE(mcap::write_scene(**file, scene));
    }
    EXPECT_TRUE((*lcm)->finish() && (*file)->finish());
  }
  const test::TempFolder folder_;
  const std::string lcm_ = folder_ / "states.lcmlog", mcap_ = folder_ / "hands.mcap";
};

TEST_F(MessageLogTest, BothFormatsHoldTheSame) {
  auto lcm = MessageLog::open(lcm_), mcap = MessageLog::open(mcap_);
  ASSERT_TRUE(lcm && mcap);
  EXPECT_TRUE(mcap->is_mcap() && !lcm->is_mcap());
  ASSERT_EQ(mcap->entries().size(), 9u);
  ASSERT_EQ(lcm->entries().size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) {
    const LogEntry &a = lcm->entries()[i], &b = mcap->entries()[i];
    EXPECT_EQ(std::tie(a.timestamp, a.channel, a.size, a.hash, a.utime, a.third),
              std::tie(b.timestamp, b.channel, b.size, b.hash, b.utime, b.third));
    EXPECT_EQ(lcm->read(a).value(), mcap->read(b).value());
  }
}

TEST_F(MessageLogTest, WhatIsCutOffIsSaid) {
  std::filesystem::resize_file(lcm_, std::filesystem::file_size(lcm_) - 5);
  test::cut_off_end(mcap_);
  for (const auto& [path, entries] : {std::pair(lcm_, 8u), {mcap_, 9u}}) {
    const auto log = MessageLog::open(path);
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_EQ(log->warnings().size(), 1u) << path;
    EXPECT_EQ(log->entries().size(), entries) << path;
  }
}

TEST_F(MessageLogTest, WhatIsNoLogIsRefused) {
  EXPECT_FALSE(MessageLog::open(folder_ / "none"));
  std::ofstream(folder_ / "empty.mcap").flush();
  EXPECT_FALSE(MessageLog::open(folder_ / "empty.mcap"));
}

}  // namespace
}  // namespace barehand
