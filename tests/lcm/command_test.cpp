#include "drivers/lcm/command.h"

#include <gtest/gtest.h>

#include <limits>

#include "drivers/lcm/layouts.h"

namespace barehand {
namespace {

command_t message(std::int8_t kind) {
  command_t m{};
  m.utime = 5;
  m.sensor = "left";
  m.hand_id = 3;
  m.command = kind;
  for (int s = 0; s < kSegmentCount; ++s) {
    m.position[s][2] = 0.5 + s;
    m.orientation[s][0] = m.orientation[s][3] = 2;  // a quarter turn about z, not normalised
  }
  m.profile = "{}";
  return m;
}

TEST(Command, InitialiseCarriesThePose) {
  const auto command = decode_command(encode_message(message(command_t::INITIALISE)));
  ASSERT_TRUE(command) << command.error().message();
  EXPECT_EQ(command->kind, Command::Kind::initialise);
  EXPECT_EQ(command->sensor, "left");
  EXPECT_EQ(command->hand_id, 3);
  EXPECT_EQ(command->pose[4].t.z(), 4.5);
  EXPECT_LT((command->pose[4].R * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(Command, AnyHandIsNoHandInParticular) {
  command_t m = message(command_t::RESET);
  m.hand_id = command_t::ANY_HAND;
  EXPECT_FALSE(decode_command(encode_message(m))->hand_id.has_value());
}

TEST(Command, ResetNeedsNoPose) {
  command_t m = message(command_t::RESET);
  m.orientation[3][0] = m.orientation[3][3] = 0;
  EXPECT_TRUE(decode_command(encode_message(m)));
}

TEST(Command, SenselessOnesAreErrors) {
  EXPECT_FALSE(decode_command(encode_message(message(0))));
  EXPECT_FALSE(decode_command(encode_message(message(4))));
  command_t m = message(command_t::INITIALISE);
  m.orientation[3][0] = m.orientation[3][3] = 0;
  EXPECT_FALSE(decode_command(encode_message(m)));
  m = message(command_t::INITIALISE);
  m.position[9][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(decode_command(encode_message(m)));
  m.position[9][1] = 1e6;
  EXPECT_FALSE(decode_command(encode_message(m)));
  m = message(command_t::SET_PROFILE);
  m.profile = "";
  EXPECT_FALSE(decode_command(encode_message(m)));
  m.profile = std::string(kLongestProfile + 1, ' ');
  EXPECT_FALSE(decode_command(encode_message(m)));
}

TEST(CommandInbox, KeepsTheNewestInOrder) {
  const std::shared_ptr<LcmBus> bus = LcmBus::open("memq://").value();
  CommandInbox inbox(bus, "*COMMAND");
  const int count = static_cast<int>(CommandInbox::kCapacity) + 3;
  for (int i = 0; i < count; ++i) {
    command_t m = message(command_t::RESET);
    m.utime = i;
    ASSERT_TRUE(bus->send("P_COMMAND", encode_message(m), 0));
  }
  std::vector<std::int64_t> times;
  while (times.empty() || times.back() != count - 1) {
    for (const auto& command : inbox.take()) times.push_back(command->utime);
    std::this_thread::yield();
  }
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i], times[i - 1]);
  EXPECT_TRUE(inbox.take().empty());
}

TEST(CommandInbox, DamagedCommandsArriveAsErrors) {
  const std::shared_ptr<LcmBus> bus = LcmBus::open("memq://").value();
  CommandInbox inbox(bus, "COMMAND");
  ASSERT_TRUE(bus->send("COMMAND", std::vector<std::uint8_t>(20), 0));
  std::vector<Result<Command>> taken;
  while (taken.empty()) taken = inbox.take();
  EXPECT_FALSE(taken[0]);
}

}  // namespace
}  // namespace barehand
