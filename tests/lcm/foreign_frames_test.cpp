#include "drivers/lcm/foreign_frames.h"

#include <gtest/gtest.h>

#include <limits>

#include "drivers/lcm/depth_codec.h"
#include "drivers/lcm/frame_message.h"
#include "drivers/lcm/layouts.h"
#include "foreign_messages.h"
#include "io/recording/image_codec.h"
#include "test_frames.h"

namespace barehand {
namespace {

constexpr GivenIntrinsics kCamera{50.5, 51.25, 19.5, 14.5};

/// The test frame as another program's message can represent it: in millimetres, without a sensor name.
RgbdFrame expected_frame() {
  RgbdFrame frame = test_frame(3);
  frame.depth_unit = 0.001;
  frame.sensor = "";
  return frame;
}

TEST(Kinect, DepthAndColourSurvive) {
  for (const bool zipped : {false, true}) {
    const auto bytes = encode_message(kinect_message(test_frame(3), zipped));
    const auto frame = decode_frame_message(bytes, kCamera, 3);
    ASSERT_TRUE(frame) << frame.error().message();
    expect_same_frame(**frame, expected_frame());
  }
}

TEST(Kinect, ColourOfAnotherSizeIsLeftOut) {
  kinect::frame_msg_t message = kinect_message(test_frame(3), true);
  message.image.width = 80;
  const auto frame = decode_kinect(message, kCamera, 0);
  EXPECT_TRUE((*frame)->colour.empty());
  EXPECT_EQ((*frame)->colour_fault.substr(0, 29), "is 80x30, depth is 40x30 (reg");
}

/// Whether the frame has its depth and no colour, and a notice that gives the reason.
bool depth_alone(const Result<std::shared_ptr<RgbdFrame>>& frame) {
  return frame && (*frame)->depth.at(5, 5) == test_frame(3).depth.at(5, 5) && (*frame)->colour.empty() &&
         !(*frame)->colour_fault.empty();
}

TEST(Kinect, ColourThatIsDamagedOrUnknownCostsNoDepth) {
  kinect::frame_msg_t message = kinect_message(test_frame(3), true);
  message.image.image_data.resize(100);
  EXPECT_TRUE(depth_alone(decode_kinect(message, kCamera, 0)));
  message = kinect_message(test_frame(3), true);
  message.image.image_data_format = 1;
  EXPECT_TRUE(depth_alone(decode_kinect(message, kCamera, 0)));
  message.image.image_data_format = kinect::image_msg_t::VIDEO_NONE;
  EXPECT_EQ((*decode_kinect(message, kCamera, 0))->colour_fault, "") << "none was promised";
}

TEST(Kinect, WithoutIntrinsicsTheErrorSaysWhatToSet) {
  const auto frame = decode_kinect(kinect_message(test_frame(3), true), {}, 0);
  ASSERT_FALSE(frame);
  EXPECT_NE(frame.error().message().find("fx"), std::string::npos);
}

TEST(Kinect, IntrinsicsThatNoCameraHasAreErrors) {
  const auto decoded = [](const GivenIntrinsics& camera) {
    EXPECT_EQ(check(camera).has_value(), decode_kinect(kinect_message(test_frame(3), true), camera, 0).has_value());
    return check(camera).has_value();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(decoded(kCamera));
  EXPECT_TRUE(decoded({525, 525, -40.5, 700}));
  EXPECT_FALSE(decoded({525, 525, 0, 0})) << "a principal point that was forgotten";
  EXPECT_FALSE(decoded({525, 0, 320, 240}));
  EXPECT_FALSE(decoded({525, 525, nan, 240}));
  EXPECT_FALSE(decoded({1e-300, 525, 320, 240}));
  EXPECT_TRUE(check({})) << "needed by foreign frames alone";
}

TEST(Kinect, LyingFieldsAreErrors) {
  const auto refused = [](auto change) {
    kinect::frame_msg_t message = kinect_message(test_frame(3), true);
    change(message);
    return !decode_kinect(message, kCamera, 0);
  };
  EXPECT_FALSE(refused([](kinect::frame_msg_t&) {}));
  EXPECT_TRUE(refused([](kinect::frame_msg_t& m) { m.depth.width = 32767; }));
  EXPECT_TRUE(refused([](kinect::frame_msg_t& m) { m.depth.height = -30; }));
  EXPECT_TRUE(refused([](kinect::frame_msg_t& m) { m.depth.depth_data_format = 0; }));
  EXPECT_TRUE(refused([](kinect::frame_msg_t& m) { m.depth.compression = 9; }));
}

TEST(BotImages, DepthAndColourSurvive) {
  for (const bool zipped : {false, true}) {
    const auto bytes = encode_message(images_message(test_frame(3), zipped));
    const auto frame = decode_frame_message(bytes, kCamera, 3);
    ASSERT_TRUE(frame) << frame.error().message();
    expect_same_frame(**frame, expected_frame());
  }
}

TEST(BotImages, BgrGreyAndPaddedRowsAreRead) {
  bot_core::images_t message = images_message(test_frame(3), true);
  bot_core::image_t& colour = message.images[0];
  colour.pixelformat = bot_core::image_t::PIXEL_FORMAT_BGR;
  const Rgb rgb = test_frame(3).colour.at(1, 0);
  EXPECT_EQ((*decode_images(message, kCamera, 0))->colour.at(1, 0), (Rgb{rgb.b, rgb.g, rgb.r}));

  colour.pixelformat = bot_core::image_t::PIXEL_FORMAT_GRAY;
  colour.row_stride = 64;
  colour.data.assign(64 * 30, 0);
  colour.data[64 + 5] = 200;
  EXPECT_EQ((*decode_images(message, kCamera, 0))->colour.at(5, 1), (Rgb{200, 200, 200}));
}

TEST(BotImages, LyingFieldsAreErrors) {
  const auto refused = [](auto change) {
    bot_core::images_t message = images_message(test_frame(3), true);
    change(message);
    return !decode_images(message, kCamera, 0);
  };
  EXPECT_FALSE(refused([](bot_core::images_t&) {}));
  EXPECT_TRUE(refused([](bot_core::images_t& m) { m.image_types[1] = 2; })) << "no depth";
  EXPECT_TRUE(refused([](bot_core::images_t& m) { m.images[1].width = 1 << 30; }));
  EXPECT_TRUE(refused([](bot_core::images_t& m) {
    for (auto& image : m.images) image.width = image.height = 2'000'000'000;
  }));
}

TEST(BotImages, ColourThatLiesCostsNoDepth) {
  const auto costs_none = [](auto change) {
    bot_core::images_t message = images_message(test_frame(3), true);
    change(message.images[0]);
    return depth_alone(decode_images(message, kCamera, 0));
  };
  EXPECT_TRUE(costs_none([](bot_core::image_t& m) { m.row_stride = -1; }));
  EXPECT_TRUE(costs_none([](bot_core::image_t& m) { m.row_stride = 1 << 30; }));
  EXPECT_TRUE(costs_none([](bot_core::image_t& m) { m.data.resize(5); }));
  EXPECT_TRUE(costs_none([](bot_core::image_t& m) { m.pixelformat = 1; }));
  EXPECT_TRUE(costs_none([](bot_core::image_t& m) { m.width = 20; }));
  EXPECT_TRUE(costs_none([](bot_core::image_t& m) { m.width = 1 << 30; }));
}

TEST(BotImages, TruncatedAndDamagedBytesAreErrorsOrFrames) {
  const auto whole = encode_message(images_message(test_frame(3), true));
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    EXPECT_FALSE(decode_frame_message(WireBytes(whole.data(), size), kCamera, 0)) << size;
  }
  auto bytes = whole;
  for (std::size_t i = 0; i < 120; ++i) {
    bytes[i] ^= 0xFF;
    const auto frame = decode_frame_message(bytes, kCamera, 0);
    EXPECT_TRUE(!frame || (*frame)->depth.size() == 1200u);
    bytes[i] ^= 0xFF;
  }
}

TEST(FrameMessage, AnotherTypeIsAnErrorThatNamesTheKnownOnes) {
  const auto frame = decode_frame_message(encode_message(command_t{}), kCamera, 0);
  ASSERT_FALSE(frame);
  EXPECT_NE(frame.error().message().find("rgbd_frame_t"), std::string::npos);
}

}  // namespace
}  // namespace barehand
