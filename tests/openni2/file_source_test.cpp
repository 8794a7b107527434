#include "drivers/openni2/openni_file_source.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <thread>

#include "openni2/source_reader.h"
#include "openni2/virtual_device/pictures.h"
#include "openni2/virtual_sensor.h"
#include "support/child_process.h"
#include "support/ordinary_user.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;

const std::string kSim = "fist,noise=kinect,width=160,height=120";

class OniFile : public ::testing::Test {
 protected:
  /// Records the virtual sensor by OpenNI2's own recorder. `fault` starts in the middle of the recording.
  void record_file(const std::string& streams, const std::string& fault = "none") {
    ChildProcess recorder({BAREHAND_RECORD_ONI, path_, "1600", streams});
    ASSERT_TRUE(recorder.wait_for("recording")) << recorder.output();
    std::this_thread::sleep_for(std::chrono::milliseconds(800));
    sensor_.set({{"fault", fault}});
    ASSERT_EQ(recorder.finish(), 0) << recorder.output();
  }
  /// The image that a frame shows; -1: none. The sensor records mirrored images at first.
  int picture_of(const RgbdFrame& frame) const {
    const auto& all = pictures_.frames;
    const auto same = [&](const FramePtr& picture) {
      return std::equal(picture->depth.data(), picture->depth.data() + picture->depth.size(), frame.depth.data());
    };
    const auto found = std::ranges::find_if(all, same);
    return found == all.end() ? -1 : static_cast<int>(found - all.begin());
  }

  VirtualSensor sensor_;
  test::TempFolder folder_;
  const std::string path_ = folder_ / "recording.oni";
  const virtual_openni::Pictures pictures_ = *virtual_openni::render_pictures(kSim, 15);
};

TEST_F(OniFile, EveryPictureIsPlayedOnceInOrderAndBitExact) {
  record_file("both");
  auto source = OpenNiFileSource::open(path_, {});
  ASSERT_TRUE(source.has_value()) << source.error().message();
  const std::int64_t total = (*source)->remaining();
  EXPECT_GE(total, 15);
  EXPECT_FALSE((*source)->live());

  // Frames are complete and in order.
  SourceReader reader(**source);
  std::int64_t count = 0, last_utime = 0, coloured = 0;
  while (const FramePtr frame = reader.frame()) {
    EXPECT_EQ(frame->number, count++);
    EXPECT_GT(frame->utime, last_utime);
    last_utime = frame->utime;
    EXPECT_EQ(frame->depth_unit, 1e-4);
    EXPECT_NEAR(frame->camera.fx, pictures_.camera().fx, 1e-3);

    // Depth and colour are those of an image that was recorded.
    const int shown = picture_of(*frame);
    ASSERT_GE(shown, 0) << "frame " << frame->number;
    if (frame->colour.empty()) continue;
    ++coloured;
    const Image<Rgb>& colour = pictures_.frames[static_cast<std::size_t>(shown)]->colour;
    EXPECT_TRUE(std::equal(colour.data(), colour.data() + colour.size(), frame->colour.data())) << frame->number;
  }

  // The file was played to its end.
  EXPECT_TRUE(reader.ended);
  EXPECT_FALSE(reader.failed) << reader.failed->message();
  EXPECT_EQ(count, total);
  EXPECT_GE(coloured, total - 3);
}

TEST_F(OniFile, ColourThatStopsDoesNotEndTheDepth) {
  record_file("both", "no_colour");
  auto source = OpenNiFileSource::open(path_, {});
  ASSERT_TRUE(source.has_value()) << source.error().message();
  const std::int64_t total = (*source)->remaining();
  SourceReader reader(**source);
  FramePtr last;
  while (const FramePtr frame = reader.frame()) last = frame;
  EXPECT_FALSE(reader.failed) << reader.failed->message();
  EXPECT_EQ(reader.delivered, total);
  ASSERT_TRUE(last);
  EXPECT_TRUE(last->colour.empty());
  EXPECT_GE(picture_of(*last), 0);
}

TEST_F(OniFile, StartAndStep) {
  // The frames of the whole file.
  record_file("depth");
  auto all = OpenNiFileSource::open(path_, {});
  ASSERT_TRUE(all.has_value()) << all.error().message();
  EXPECT_THAT((*all)->warning().value_or(""), HasSubstr("no colour"));
  SourceReader reader(**all);
  const auto frames = reader.frames(9);
  all->reset();

  // Every third one from the second on.
  auto some = OpenNiFileSource::open(path_, {}, 2, 3);
  ASSERT_TRUE(some.has_value()) << some.error().message();
  SourceReader skipping(**some);
  for (const std::size_t number : {2u, 5u, 8u}) {
    const FramePtr frame = skipping.frame();
    ASSERT_TRUE(frame && number < frames.size());
    EXPECT_EQ(frame->number, static_cast<std::int64_t>(number));
    EXPECT_EQ(frame->utime, frames[number]->utime);
    EXPECT_EQ(picture_of(*frame), picture_of(*frames[number]));  // counted from the beginning of the file
  }
}

TEST_F(OniFile, AFileThatTellsNoFieldOfViewNeedsItsIntrinsics) {
  sensor_.set({{"field_of_view", "0"}});
  record_file("depth");
  const auto without = OpenNiFileSource::open(path_, {});
  ASSERT_FALSE(without.has_value());
  EXPECT_THAT(without.error().message(), HasSubstr("does not report its field of view"));
  EXPECT_THAT(without.error().remedy, HasSubstr("--fx --fy --cx --cy"));
  OpenNiParams given;
  given.camera = {150, 151, 79, 61};
  const auto with = OpenNiFileSource::open(path_, given);
  EXPECT_TRUE(with.has_value()) << with.error().message();
}

TEST_F(OniFile, ThatThisUserMayNotReadIsSaid) {
  test::write_text(path_, "NI10");
  chmod(folder_.path().c_str(), 0755);
  chmod(path_.c_str(), 0);
  const auto secret = [this] {
    const test::OrdinaryUser user;
    return OpenNiFileSource::open(path_, {});
  }();
  ASSERT_FALSE(secret.has_value());
  EXPECT_THAT(secret.error().message(), HasSubstr("this user may not read it"));
}

TEST_F(OniFile, WhatCannotBePlayedIsRefusedWithTheReason) {
  EXPECT_THAT(OpenNiFileSource::open("/nonexistent.oni", {}).error().message(), HasSubstr("no such file"));
  test::write_text(path_, "this is no recording");
  const auto nonsense = OpenNiFileSource::open(path_, {});
  ASSERT_FALSE(nonsense.has_value());
  EXPECT_THAT(nonsense.error().message(), HasSubstr("is not an OpenNI recording"));
  test::write_text(path_, "NI10 and then nothing");
  const auto cut = OpenNiFileSource::open(path_, {});
  ASSERT_FALSE(cut.has_value());
  EXPECT_THAT(cut.error().message(), HasSubstr("give a complete .oni recording"));
  EXPECT_FALSE(OpenNiFileSource::open(path_, {}, 0, -1).has_value());
}

}  // namespace
}  // namespace barehand
