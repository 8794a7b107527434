#include "drivers/lcm/frame_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drivers/lcm/layouts.h"
#include "io/recording/image_codec.h"
#include "io/recording/jpeg_codec.h"
#include "io/recording/png_codec.h"
#include "test_frames.h"

namespace barehand {
namespace {

rgbd_frame_t message_of(const FrameEncoding& encoding = {}) { return encode_frame(test_frame(3), encoding).value(); }

class LosslessFrame : public testing::TestWithParam<std::tuple<DepthEncoding, ColourEncoding>> {};

TEST_P(LosslessFrame, SurvivesTheMessage) {
  const auto [depth, colour] = GetParam();
  const RgbdFrame frame = test_frame(3);
  const auto bytes = encode_message(encode_frame(frame, {depth, colour}).value());
  const auto decoded = decode_frame(decode_message<rgbd_frame_t>(bytes).value());
  ASSERT_TRUE(decoded) << decoded.error().message();
  expect_same_frame(**decoded, frame);
}

INSTANTIATE_TEST_SUITE_P(All, LosslessFrame,
                         testing::Combine(testing::Values(DepthEncoding::raw16, DepthEncoding::zlib,
                                                          DepthEncoding::rvl_zstd),
                                          testing::Values(ColourEncoding::raw_rgb, ColourEncoding::png)));

TEST(FrameCodec, JpegColourIsClose) {
  RgbdFrame frame = test_frame(3, 64, 48);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u)
      frame.colour.at(u, v) = {static_cast<std::uint8_t>(3 * u), static_cast<std::uint8_t>(4 * v), 60};
  }
  const auto decoded = decode_frame(encode_frame(frame, {.colour = ColourEncoding::jpeg}).value());
  ASSERT_TRUE(decoded);
  for (std::size_t i = 0; i < frame.colour.size(); ++i) {
    const Rgb a = (*decoded)->colour[i], b = frame.colour[i];
    ASSERT_LE(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 30) << "pixel " << i;
  }
}

TEST(FrameCodec, AFrameWithoutColourStaysWithout) {
  RgbdFrame frame = test_frame(3);
  frame.colour = {};
  const rgbd_frame_t message = encode_frame(frame, {}).value();
  EXPECT_EQ(message.colour_encoding, rgbd_frame_t::COLOUR_NONE);
  EXPECT_TRUE((*decode_frame(message))->colour.empty());
  EXPECT_EQ((*decode_frame(message))->colour_fault, "");
}

TEST(FrameCodec, AFrameWhoseImagesDifferFromItsIntrinsicsIsNotEncoded) {
  RgbdFrame frame = test_frame(3);
  frame.depth = Image<std::uint16_t>(10, 10);
  EXPECT_FALSE(encode_frame(frame, {}));
  frame = test_frame(3);
  frame.colour = Image<Rgb>(10, 10);
  EXPECT_FALSE(encode_frame(frame, {}));
}

TEST(FrameCodec, LyingSizesAreErrors) {
  for (const auto colour : {ColourEncoding::raw_rgb, ColourEncoding::jpeg, ColourEncoding::png}) {
    rgbd_frame_t message = message_of({.colour = colour});
    message.width = 41;
    EXPECT_FALSE(decode_frame(message));
    message.width = 2'000'000'000;
    EXPECT_FALSE(decode_frame(message));
    message.width = -40;
    EXPECT_FALSE(decode_frame(message));
  }
}

/// Expects that the message is decoded to the test frame's depth without colour, with a notice that gives the reason.
void expect_depth_alone(const rgbd_frame_t& message) {
  const auto decoded = decode_frame(message);
  ASSERT_TRUE(decoded) << decoded.error().message();
  RgbdFrame depth_alone = test_frame(3);
  depth_alone.colour = {};
  expect_same_frame(**decoded, depth_alone);
  EXPECT_NE((*decoded)->colour_fault, "");
}

TEST(FrameCodec, ColourOfAnotherSizeCostsNoDepth) {
  rgbd_frame_t message = message_of();
  message.colour = encode_png(Image<Rgb>(20, 15)).value();
  expect_depth_alone(message);
  message.colour = encode_jpeg(Image<Rgb>(20, 15), 90).value();
  expect_depth_alone(message);
  message = message_of({.colour = ColourEncoding::raw_rgb});
  message.colour.resize(message.colour.size() * 4);
  expect_depth_alone(message);
}

TEST(FrameCodec, DamagedColourCostsNoDepth) {
  for (const auto colour : {ColourEncoding::jpeg, ColourEncoding::png, ColourEncoding::raw_rgb}) {
    rgbd_frame_t message = message_of({.colour = colour});
    message.colour.resize(message.colour.size() / 2);
    expect_depth_alone(message);
    message.colour = {0xFF};
    expect_depth_alone(message);
    message.colour.clear();
    expect_depth_alone(message);
  }
  rgbd_frame_t message = message_of();
  message.colour_encoding = 77;
  expect_depth_alone(message);
  message.colour_encoding = rgbd_frame_t::COLOUR_NONE;  // although the message contains colour
  expect_depth_alone(message);
}

TEST(FrameCodec, MissingIntrinsicsOrDepthUnitIsAnError) {
  const auto refused = [](auto change) {
    rgbd_frame_t message = message_of();
    change(message);
    return !decode_frame(message);
  };
  EXPECT_TRUE(refused([](rgbd_frame_t& m) { m.fx = 0; }));
  EXPECT_TRUE(refused([](rgbd_frame_t& m) { m.fy = -500; }));
  EXPECT_TRUE(refused([](rgbd_frame_t& m) { m.cx = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](rgbd_frame_t& m) { m.fx = 1e-300; }));
  EXPECT_TRUE(refused([](rgbd_frame_t& m) { m.cy = -1e300; }));
  EXPECT_TRUE(refused([](rgbd_frame_t& m) { m.depth_unit = 0; }));
  EXPECT_TRUE(refused([](rgbd_frame_t& m) { m.depth_unit = 1e-300; }));
  EXPECT_TRUE(refused([](rgbd_frame_t& m) { m.depth_unit = std::numeric_limits<double>::infinity(); }));
  EXPECT_FALSE(refused([](rgbd_frame_t&) {}));
}

TEST(FrameCodec, AnUnknownEncodingOfDepthIsAnError) {
  rgbd_frame_t message = message_of();
  message.depth_encoding = 77;
  EXPECT_FALSE(decode_frame(message));
}

// The decoder that lcm-gen generates would allocate the sizes that these messages state.
TEST(FrameCodec, LyingArrayLengthsInTheBytesAreErrors) {
  const rgbd_frame_t message = message_of();
  auto bytes = encode_message(message);
  const std::size_t depth_size_at = 8 + 8 + 8 + (4 + message.sensor.size() + 1) + 4 + 4 + 5 * 8 + 1;
  ASSERT_EQ(bytes[depth_size_at + 3], message.depth_size & 0xFF) << "the test looks at the wrong place";
  for (const std::uint8_t high : {0x7F, 0x80, 0xFF}) {
    bytes[depth_size_at] = high;
    EXPECT_FALSE(decode_message<rgbd_frame_t>(bytes));
  }
}

TEST(FrameCodec, ANameThatEndsBeforeItsLengthIsAnError) {
  auto bytes = encode_message(message_of());
  const std::size_t name_at = 8 + 8 + 8 + 4;
  ASSERT_EQ(bytes[name_at], message_of().sensor[0]) << "the test looks at the wrong place";
  EXPECT_TRUE(decode_message<rgbd_frame_t>(bytes));
  bytes[name_at] = 0;
  EXPECT_FALSE(decode_message<rgbd_frame_t>(bytes));
}

TEST(ImageCodec, SizeIsReadWithoutDecoding) {
  const Image<Rgb> image(37, 21, Rgb{10, 20, 30});
  EXPECT_EQ(compressed_image_size(encode_png(image).value()).value(), (ImageSize{37, 21}));
  EXPECT_EQ(compressed_image_size(encode_jpeg(image, 80).value()).value(), (ImageSize{37, 21}));
  EXPECT_FALSE(compressed_image_size(std::vector<std::uint8_t>(100, 0x41)));
}

}  // namespace
}  // namespace barehand
