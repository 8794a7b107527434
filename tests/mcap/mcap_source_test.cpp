#include "drivers/mcap/mcap_source.h"

#include <gmock/gmock.h>

#include "io/mcap/mcap_scene.h"
#include "io/recording/png_codec.h"
#include "io/ros/ros_frame.h"
#include "mcap_bytes.h"
#include "support/temp_folder.h"
#include "tests/lcm/test_frames.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class McapReplay : public testing::Test {
 protected:
  void write(const std::vector<RgbdFrame>& frames, double fps = 0) {
    auto file = mcap::McapWriter::create(path_, true).value();
    for (const RgbdFrame& frame : frames) {
      ros::Scene scene;
      scene.utime = frame.utime;
      scene.number = frame.number;
      scene.fps = fps;
      scene.frame = std::make_shared<RgbdFrame>(frame);
      ASSERT_TRUE(mcap::write_scene(*file, scene));
    }
    ASSERT_TRUE(file->finish());
  }
  std::vector<FramePtr> play(const McapOptions& options = {}) {
    auto source = McapSource::open(path_, options);
    if (!source) {
      error_ = source.error().message();
      return {};
    }
    warnings_ = (*source)->warnings();
    fps_ = (*source)->fps();
    std::vector<FramePtr> frames;
    while (true) {
      const SourceEvent event = (*source)->next(std::chrono::milliseconds(0));
      if (const auto* frame = std::get_if<FramePtr>(&event)) frames.push_back(*frame);
      if (const auto* skipped = std::get_if<SkippedFrame>(&event)) skipped_.push_back(skipped->error.message());
      if (std::holds_alternative<EndOfStream>(event)) return frames;
    }
  }
  std::vector<std::int64_t> numbers(const McapOptions& options = {}) {
    std::vector<std::int64_t> numbers;
    for (const FramePtr& frame : play(options)) numbers.push_back(frame->number);
    return numbers;
  }

  test::TempFolder folder_;
  std::string path_ = folder_ / "a.mcap", error_;
  std::vector<std::string> warnings_, skipped_;
  double fps_ = 0;
};

/// A ROS bag as another program writes it, with depth in millimetres and colour; the arguments change it.
class Bag {
 public:
  Bag() {
    frame_.sensor = "";
    frame_.depth_unit = 0.001;
    depth_ = ros::depth_image(frame_);
    info_ = ros::camera_info(frame_);
    colour_ = ros::colour_image(frame_, std::nullopt).value();
  }
  void write(const std::string& path, const std::string& depth = "/cam/depth/image_raw") {
    test::ForeignMcap file;
    file.channel(1, depth, "sensor_msgs/msg/Image").channel(2, "/cam/depth/camera_info", "sensor_msgs/msg/CameraInfo");
    file.channel(3, "/cam/color/image_raw/compressed", "sensor_msgs/msg/CompressedImage");
    file.message(2, ros::encode(info_)).message(1, ros::encode(depth_)).message(3, ros::encode(colour_));
    file.write(path);
  }
  RgbdFrame frame_ = test_frame(5);
  ros::Image depth_;
  ros::CameraInfo info_;
  ros::CompressedImage colour_;
};

TEST_F(McapReplay, FramesComeBackAsTheyWere) {
  write({test_frame(3), test_frame(4)}, 30);
  const auto frames = play();
  ASSERT_EQ(frames.size(), 2u);
  expect_same_frame(*frames[0], test_frame(3));
  expect_same_frame(*frames[1], test_frame(4));
  EXPECT_EQ(fps_, 30);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(McapReplay, TimesBeforeTheEpochAndUnitsThatChangeAreKept) {
  std::vector<RgbdFrame> frames{test_frame(0), test_frame(1), test_frame(2)};
  for (int i = 0; i < 3; ++i) frames[static_cast<std::size_t>(i)].utime = -70'000 + 33'333 * i;
  frames[2].depth_unit = 0.001;
  frames[2].camera.fx = 60;
  write(frames);
  const auto played = play();
  ASSERT_EQ(played.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) expect_same_frame(*played[i], frames[i]);
}

TEST_F(McapReplay, StartAndStepChooseFrames) {
  write({test_frame(0), test_frame(1), test_frame(2), test_frame(3), test_frame(4)});
  McapOptions options;
  options.start = 1;
  options.step = 2;
  EXPECT_THAT(numbers(options), ElementsAre(1, 3));
  options.start = {};
  options.step = -2;
  EXPECT_THAT(numbers(options), ElementsAre(4, 2, 0));
  options.start = 9;
  EXPECT_THAT(numbers(options), IsEmpty());
  EXPECT_THAT(error_, HasSubstr("frames 0 to 4"));
}

TEST_F(McapReplay, ARepeatedStampIsSkipped) {
  RgbdFrame again = test_frame(2);
  again.utime = test_frame(1).utime;
  write({test_frame(1), again, test_frame(3)});
  EXPECT_THAT(numbers(), ElementsAre(1, 3));
  EXPECT_EQ(skipped_.size(), 1u);
}

TEST_F(McapReplay, OfSeveralSensorsOneIsChosen) {
  RgbdFrame other = test_frame(1);
  other.sensor = "other";
  write({test_frame(1), other, test_frame(2)});
  EXPECT_THAT(numbers(), IsEmpty());
  EXPECT_THAT(error_, AllOf(HasSubstr("/other/depth, /test/depth"), HasSubstr("--channel")));
  McapOptions options;
  options.channel = "/other/*";
  const auto frames = play(options);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0]->sensor, "other");
  options.channel = "*";
  EXPECT_EQ(play(options).size(), 3u) << "in the order of the file";
  options.channel = "/none";
  EXPECT_THAT(play(options), IsEmpty());
  EXPECT_THAT(error_, HasSubstr("no topic with depth images matches"));
}

TEST_F(McapReplay, ABagOfAnotherProgramIsPlayed) {
  const Bag bag;
  Bag(bag).write(path_);
  const auto frames = play();
  ASSERT_EQ(frames.size(), 1u) << error_;
  RgbdFrame expected = bag.frame_;
  expected.number = 0;
  expect_same_frame(*frames[0], expected);
}

TEST_F(McapReplay, ColourOfAnotherFrameIsNotUsedAndThatIsSaid) {
  Bag bag;
  bag.colour_.header.frame_id = "cam_color_optical_frame";
  bag.write(path_);
  const auto frames = play();
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_TRUE(frames[0]->colour.empty());
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("registered to depth")));
}

TEST_F(McapReplay, DamagedColourLeavesDepth) {
  Bag bag;
  bag.colour_.data.resize(bag.colour_.data.size() / 2);
  bag.write(path_);
  const auto frames = play();
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_TRUE(frames[0]->colour.empty());
  EXPECT_FALSE(frames[0]->colour_fault.empty());
}

TEST_F(McapReplay, LensDistortionIsSaid) {
  Bag bag;
  bag.info_.d = {0.1, 0, 0, 0, 0};
  bag.write(path_);
  EXPECT_EQ(play().size(), 1u);
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("lens distortion")));
}

TEST_F(McapReplay, WithoutCameraInfoIntrinsicsAreAskedFor) {
  Bag().write(path_, "/elsewhere/depth");
  EXPECT_THAT(play(), IsEmpty());
  EXPECT_THAT(error_, AllOf(HasSubstr("/elsewhere/camera_info"), HasSubstr("--fx")));
  McapOptions options;
  options.foreign = {50, 51, 20, 15};
  const auto frames = play(options);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0]->camera.fx, 50);
}

TEST_F(McapReplay, CompressedDepthIsRead) {
  const Bag bag;
  ros::CompressedImage packed{bag.depth_.header, "16UC1; compressedDepth png", test::Bytes(12)};
  const auto png = encode_png(bag.frame_.depth).value();
  packed.data.insert(packed.data.end(), png.begin(), png.end());
  test::ForeignMcap file;
  file.channel(1, "/cam/depth/compressed", "sensor_msgs/msg/CompressedImage");
  file.channel(2, "/cam/depth/camera_info", "sensor_msgs/msg/CameraInfo");
  file.message(2, ros::encode(bag.info_)).message(1, ros::encode(packed)).write(path_);
  const auto frames = play();
  ASSERT_EQ(frames.size(), 1u) << error_;
  EXPECT_EQ(frames[0]->depth.at(7, 7), bag.frame_.depth.at(7, 7));
}

TEST_F(McapReplay, WhatHoldsNoDepthIsSaidWithItsTopics) {
  test::ForeignMcap file;
  file.channel(1, "/chatter", "std_msgs/msg/String").channel(2, "/picture", "foxglove.CompressedImage", "protobuf");
  file.message(1, {0, 1, 0, 0}).message(2, {1, 2, 3}).write(path_);
  EXPECT_THAT(play(), IsEmpty());
  EXPECT_THAT(error_, AllOf(HasSubstr("no depth images"), HasSubstr("/chatter (std_msgs/msg/String)"),
                            HasSubstr("/picture (foxglove.CompressedImage)"), HasSubstr("16UC1")));
  test::ForeignMcap().write(path_);
  EXPECT_THAT(play(), IsEmpty());
  EXPECT_THAT(error_, HasSubstr("holds no message that can be read"));
  test::ForeignMcap().chunk("lz4", 10, {1, 2, 3}).write(path_);
  EXPECT_THAT(play(), IsEmpty());
  EXPECT_THAT(error_, HasSubstr("mcap compress --compression zstd"));
}

TEST_F(McapReplay, AFrameThatLiesIsSkipped) {
  Bag bag;
  bag.depth_.data.resize(100);
  bag.write(path_);
  EXPECT_THAT(play(), IsEmpty());
  EXPECT_THAT(skipped_, ElementsAre(HasSubstr("fewer pixels than its size says")));
}

}  // namespace
}  // namespace barehand
