#include "drivers/lcm/depth_codec.h"

#include <gtest/gtest.h>

#include "drivers/lcm/rvl.h"
#include "test_frames.h"

namespace barehand {
namespace {

class DepthCodec : public testing::TestWithParam<DepthEncoding> {};

void expect_round_trip(const Image<std::uint16_t>& depth, DepthEncoding encoding) {
  const auto decoded = decode_depth(encode_depth(depth, encoding), encoding, depth.width(), depth.height());
  ASSERT_TRUE(decoded) << decoded.error().message();
  ASSERT_EQ(decoded->size(), depth.size());
  for (std::size_t i = 0; i < depth.size(); ++i) ASSERT_EQ((*decoded)[i], depth[i]) << "pixel " << i;
}

TEST_P(DepthCodec, ReturnsEveryCount) { expect_round_trip(test_frame(1).depth, GetParam()); }

TEST_P(DepthCodec, ReturnsAnImageWithoutMeasurements) { expect_round_trip({7, 5}, GetParam()); }

TEST_P(DepthCodec, ReturnsTheSteepestSteps) {
  Image<std::uint16_t> depth(64, 2);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = i % 3 == 0 ? 65535 : i % 3 == 1 ? 1 : 0;
  expect_round_trip(depth, GetParam());
}

TEST_P(DepthCodec, TruncatedCodeIsAnError) {
  const RgbdFrame frame = test_frame(1);
  const auto code = encode_depth(frame.depth, GetParam());
  for (std::size_t size = 0; size < code.size(); ++size) {
    EXPECT_FALSE(decode_depth(std::span(code.data(), size), GetParam(), frame.camera.width, frame.camera.height))
        << size;
  }
}

TEST_P(DepthCodec, CodeOfAnotherSizeIsAnError) {
  const RgbdFrame frame = test_frame(1);
  const auto code = encode_depth(frame.depth, GetParam());
  EXPECT_FALSE(decode_depth(code, GetParam(), frame.camera.width, frame.camera.height - 1));
  EXPECT_FALSE(decode_depth(code, GetParam(), frame.camera.width, frame.camera.height + 1));
}

TEST_P(DepthCodec, AnImpossibleSizeIsRefusedBeforeMemoryIsSpent) {
  const auto code = encode_depth(test_frame(1).depth, GetParam());
  EXPECT_FALSE(decode_depth(code, GetParam(), 0, 30));
  EXPECT_FALSE(decode_depth(code, GetParam(), -40, -30));
  EXPECT_FALSE(decode_depth(code, GetParam(), 2'000'000'000, 2'000'000'000));
}

TEST_P(DepthCodec, NoDamagedByteCrashes) {
  const RgbdFrame frame = test_frame(1);
  auto code = encode_depth(frame.depth, GetParam());
  for (std::uint8_t& byte : code) {
    byte ^= 0xA5;
    const auto decoded = decode_depth(code, GetParam(), 40, 30);
    EXPECT_TRUE(!decoded || decoded->size() == frame.depth.size());
    byte ^= 0xA5;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DepthCodec,
                         testing::Values(DepthEncoding::raw16, DepthEncoding::zlib, DepthEncoding::rvl_zstd));

TEST(DepthCodec, AnUnknownEncodingIsAnError) {
  EXPECT_FALSE(decode_depth(std::vector<std::uint8_t>(24), static_cast<DepthEncoding>(9), 4, 3));
}

// The expected code was derived by hand: 2 zeros, 1 measured pixel, difference 5 -> zigzag 10 = 010 001 -> nibbles 1010
// 0001; then 1 zero and 0 measured pixels.
TEST(Rvl, CodeIsAsWritten) {
  const std::vector<std::uint16_t> counts = {0, 0, 5, 0};
  EXPECT_EQ(rvl_encode(counts), (std::vector<std::uint8_t>{0x21, 0xA1, 0x10}));
}

TEST(Rvl, TrailingCodeIsAnError) {
  std::vector<std::uint16_t> counts(4);
  EXPECT_TRUE(rvl_decode(std::vector<std::uint8_t>{0x21, 0xA1, 0x10}, counts));
  EXPECT_FALSE(rvl_decode(std::vector<std::uint8_t>{0x21, 0xA1, 0x10, 0x00}, counts));
}

TEST(Rvl, RunsPastTheImageAreAnError) {
  std::vector<std::uint16_t> counts(3);
  EXPECT_FALSE(rvl_decode(std::vector<std::uint8_t>{0x40}, counts));
  EXPECT_FALSE(rvl_decode(std::vector<std::uint8_t>{0x00, 0x00}, counts)) << "a run of nothing";
}

}  // namespace
}  // namespace barehand
