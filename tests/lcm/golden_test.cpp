#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "drivers/lcm/layouts.h"
#include "golden_messages.h"

namespace barehand {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes golden_bytes(const std::string& type) {
  std::ifstream file(std::string(BAREHAND_GOLDEN_DIR) + "/" + type + ".bin", std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

/// Whether the message is encoded to the golden bytes, and these are decoded to the message.
template <class Message>
bool holds(const Bytes& golden, const Message& message) {
  if (encode_message(message) != golden) return false;
  const auto decoded = decode_message<Message>(golden);
  return decoded && encode_message(*decoded) == golden;
}

template <class Message>
Message fixed();
template <>
rgbd_frame_t fixed() {
  return golden::rgbd_frame();
}
template <>
hand_state_t fixed() {
  return golden::hand_state();
}
template <>
glove_state_t fixed() {
  return golden::glove_state();
}
template <>
hand_joints_t fixed() {
  return golden::hand_joints();
}
template <>
contact_state_t fixed() {
  return golden::contact_state();
}
template <>
grasp_state_t fixed() {
  return golden::grasp_state();
}
template <>
object_state_t fixed() {
  return golden::object_state();
}
template <>
health_t fixed() {
  return golden::health();
}
template <>
command_t fixed() {
  return golden::command();
}

template <class Message>
class GoldenMessage : public testing::Test {};
using Types = testing::Types<rgbd_frame_t, hand_state_t, glove_state_t, hand_joints_t, contact_state_t, grasp_state_t,
                             object_state_t, health_t, command_t>;
TYPED_TEST_SUITE(GoldenMessage, Types);

TYPED_TEST(GoldenMessage, EncodesAndDecodesAsEver) {
  const Bytes golden = golden_bytes(TypeParam::getTypeName());
  ASSERT_FALSE(golden.empty());
  EXPECT_TRUE(holds(golden, fixed<TypeParam>())) << "the type changed: logs written before cannot be read any more";
}

TYPED_TEST(GoldenMessage, EveryChangedByteIsNoticed) {
  Bytes golden = golden_bytes(TypeParam::getTypeName());
  for (std::uint8_t& byte : golden) {
    byte ^= 0x11;
    EXPECT_FALSE(holds(golden, fixed<TypeParam>())) << "byte " << &byte - golden.data();
    byte ^= 0x11;
  }
}

TYPED_TEST(GoldenMessage, EveryTruncationIsAnError) {
  const Bytes golden = golden_bytes(TypeParam::getTypeName());
  for (std::size_t size = 0; size < golden.size(); ++size) {
    EXPECT_FALSE(decode_message<TypeParam>(WireBytes(golden.data(), size))) << size;
  }
}

TYPED_TEST(GoldenMessage, NoDamagedByteCrashesTheDecoder) {
  Bytes golden = golden_bytes(TypeParam::getTypeName());
  int refused = 0;
  for (std::uint8_t& byte : golden) {
    for (const std::uint8_t value : {0x00, 0x7F, 0x80, 0xFF}) {
      const std::uint8_t before = std::exchange(byte, value);
      refused += decode_message<TypeParam>(golden) ? 0 : 1;
      byte = before;
    }
  }
  EXPECT_GE(refused, 4 * 7) << "at least every damage to the fingerprint is refused";
}

// The fingerprints in the code of the original projects. Their logs can be played only if ours are the same.
TEST(ForeignTypes, FingerprintsMatchTheOriginals) {
  const auto rotated = [](std::uint64_t sum) { return static_cast<std::int64_t>((sum << 1) + (sum >> 63)); };
  const auto image = static_cast<std::uint64_t>(rotated(0x01fc0e88fea09363));
  const auto depth = static_cast<std::uint64_t>(rotated(0x2006d888ce0bb5f6));
  EXPECT_EQ(kinect::frame_msg_t::getHash(), rotated(0x92191b3e928f7e79 + image + depth));
  const auto metadata = static_cast<std::uint64_t>(rotated(0x4d25b1a682bbfdc7));
  EXPECT_EQ(bot_core::image_t::getHash(), rotated(0x6fee6cb20472ff6a + metadata));
}

}  // namespace
}  // namespace barehand
