#include "drivers/openni2/openni_live_source.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <thread>

#include "drivers/openni2/openni_devices.h"
#include "openni2/source_reader.h"
#include "openni2/virtual_device/pictures.h"
#include "openni2/virtual_sensor.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Settings = VirtualSensor::Settings;

const std::string kSim = "fist,noise=kinect,width=160,height=120";
constexpr int kPictures = 15;

/// A source at the virtual sensor, and its reader.
struct Stream {
  explicit Stream(Settings settings = {}, OpenNiParams params = sized(), const std::string& wanted = "",
                  std::size_t capacity = 64)
      : sensor(std::move(settings)), source(wanted, params, capacity, clock), reader(source) {}
  static OpenNiParams sized() {
    OpenNiParams params;
    params.width = 160;
    params.height = 120;
    return params;
  }

  SystemClock clock;
  VirtualSensor sensor;
  OpenNiLiveSource source;
  SourceReader reader;
};

const virtual_openni::Pictures& pictures() {
  static const auto rendered = virtual_openni::render_pictures(kSim, kPictures);
  return *rendered;
}

/// The image that a frame shows; -1: none.
int picture_of(const RgbdFrame& frame) {
  const auto same = [&](const FramePtr& picture) {
    return std::equal(picture->depth.data(), picture->depth.data() + picture->depth.size(), frame.depth.data());
  };
  const auto& all = pictures().frames;
  const auto found = std::ranges::find_if(all, same);
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

TEST(OpenNiLiveSource, DeliversEveryPixelWithItsColourAndCamera) {
  Stream stream;
  for (const FramePtr& frame : stream.reader.frames(20)) {
    // Depth, unit and camera.
    const int shown = picture_of(*frame);
    ASSERT_GE(shown, 0) << "depth of frame " << frame->number;
    EXPECT_EQ(frame->depth_unit, 1e-4);
    const Intrinsics& truth = pictures().camera();
    EXPECT_NEAR(frame->camera.fx, truth.fx, 1e-3);
    EXPECT_NEAR(frame->camera.fy, truth.fy, 1e-3);
    EXPECT_EQ(frame->camera.cx, truth.cx);
    EXPECT_EQ(frame->camera.cy, truth.cy);

    // Colour.
    if (frame->colour.empty()) continue;  // the cameras do not start at the same moment
    const Image<Rgb>& colour = pictures().frames[static_cast<std::size_t>(shown)]->colour;
    EXPECT_TRUE(std::equal(colour.data(), colour.data() + colour.size(), frame->colour.data())) << frame->number;
  }
  EXPECT_THAT(
      stream.reader.notices,
      HasSubstr(
          "opened Barehand Virtual Sensor at virtual/1: 160x120 at 30 Hz, 0.1 mm, colour registered, synchronised"));
}

TEST(OpenNiLiveSource, NumbersAndTimesCountWhatTheSensorExposed) {
  Stream stream;
  const auto frames = stream.reader.frames(60);
  ASSERT_EQ(frames.size(), 60u);

  // Numbers and times agree with the rate.
  const FramePtr& first = frames[20];  // by now the offset of the sensor's clock has been estimated
  for (std::size_t i = 21; i < frames.size(); ++i) {
    EXPECT_GT(frames[i]->number, frames[i - 1]->number);
    const double expected = 1e6 / 30 * static_cast<double>(frames[i]->number - first->number);
    EXPECT_NEAR(static_cast<double>(frames[i]->utime - first->utime), expected, 5e3);
  }
  EXPECT_LT(std::abs(stream.clock.utime() - frames.back()->utime), 5'000'000);

  // The counts agree when all frames have arrived.
  stream.sensor.set({{"fault", "stall"}});
  ASSERT_TRUE(stream.reader.told("stalled"));  // all frames have arrived
  const auto queues = stream.source.queues();
  EXPECT_EQ(queues[0].popped, queues[1].pushed + stream.reader.skipped);
  EXPECT_EQ(queues[0].pushed, queues[0].popped + queues[0].dropped);
}

TEST(OpenNiLiveSource, NewestFrameWins) {
  Stream stream({}, Stream::sized(), "", 1);
  const FramePtr before = stream.reader.frame();
  ASSERT_TRUE(before);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // a slow tracker
  const FramePtr after = stream.reader.frame();
  ASSERT_TRUE(after);
  EXPECT_GE(after->number, before->number + 5);
  EXPECT_GE(stream.source.queues()[1].dropped, 4);
}

TEST(OpenNiLiveSource, ConfiguredIntrinsicsReplaceTheSensorsOwn) {
  OpenNiParams params = Stream::sized();
  params.camera = {150, 151, 79, 61};
  Stream stream({}, params);
  const FramePtr frame = stream.reader.frame();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->camera, (Intrinsics{160, 120, 150, 151, 79, 61}));
}

TEST(OpenNiLiveSource, IntrinsicsThatNoCameraHasAreRefused) {
  OpenNiParams params = Stream::sized();
  params.camera = {0.5, 151, 79, 61};
  Stream stream({}, params);
  EXPECT_TRUE(stream.reader.told("virtual/1 does not match the given fx, fy, cx and cy")) << stream.reader.notices;
  EXPECT_EQ(stream.reader.delivered, 0);
}

TEST(OpenNiLiveSource, ASensorThatTellsNoFieldOfViewNeedsItsIntrinsics) {
  Stream without(Settings{{"field_of_view", "0"}});
  EXPECT_TRUE(without.reader.told("virtual/1 does not report its field of view (give fx, fy, cx and cy"))
      << without.reader.notices;
}

TEST(OpenNiLiveSource, TurnsRoundWhatTheSensorMirrors) {
  Stream stream(Settings{{"mirror_fixed", "1"}});
  const FramePtr frame = stream.reader.frame([](const RgbdFrame& f) { return !f.colour.empty(); });
  ASSERT_TRUE(frame);
  const int shown = picture_of(*frame);
  ASSERT_GE(shown, 0);
  const Image<Rgb>& colour = pictures().frames[static_cast<std::size_t>(shown)]->colour;
  EXPECT_TRUE(std::equal(colour.data(), colour.data() + colour.size(), frame->colour.data()));
  EXPECT_TRUE(stream.reader.told("only mirrored"));
}

TEST(OpenNiLiveSource, LeavesOutColourThatIsNotConfirmedToLieOverDepth) {
  for (const char* reason : {"registration", "lies"}) {
    Stream stream(Settings{{reason, std::string(reason) == "lies" ? "1" : "0"}});
    EXPECT_TRUE(stream.reader.told("colour is not used: the sensor does not register it to depth")) << reason;
    for (const FramePtr& frame : stream.reader.frames(10)) {
      EXPECT_TRUE(frame->colour.empty()) << reason;
      EXPECT_GE(picture_of(*frame), 0);
    }
  }
}

TEST(OpenNiLiveSource, UsesColourThatTheUserVouchesFor) {
  OpenNiParams params = Stream::sized();
  params.colour = "always";
  Stream stream(Settings{{"registration", "0"}}, params);
  EXPECT_TRUE(stream.reader.frame([](const RgbdFrame& f) { return !f.colour.empty(); }));
  EXPECT_THAT(stream.reader.notices, HasSubstr("does not confirm"));
}

TEST(OpenNiLiveSource, PairsByTimeWhatIsNotExposedInStep) {
  Stream stream(Settings{{"sync", "0"}});
  ASSERT_TRUE(stream.reader.told("does not synchronise depth and colour"));
  stream.reader.frames(5);
  const auto frames = stream.reader.frames(30);
  int coloured = 0;
  for (const FramePtr& frame : frames) {
    if (frame->colour.empty()) continue;
    ++coloured;
    const Image<Rgb>& colour = pictures().frames[static_cast<std::size_t>(picture_of(*frame))]->colour;
    EXPECT_TRUE(std::equal(colour.data(), colour.data() + colour.size(), frame->colour.data())) << frame->number;
  }
  EXPECT_GE(coloured, 20);
}

TEST(OpenNiLiveSource, HoldsWhatTheSensorClaimsAgainstItsTimeStamps) {
  OpenNiParams params = Stream::sized();
  params.colour = "always";
  Stream stream(Settings{{"sync", "0"}, {"lies", "1"}}, params);
  ASSERT_TRUE(stream.reader.told("not synchronised although the sensor reports")) << stream.reader.notices;
  EXPECT_TRUE(stream.reader.frame([](const RgbdFrame& f) { return !f.colour.empty(); }));
}

TEST(OpenNiLiveSource, DepthAloneWillDo) {
  Stream stream(Settings{{"colour", "0"}});
  const FramePtr frame = stream.reader.frame();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->colour.empty());
  EXPECT_THAT(stream.reader.notices, HasSubstr("has no colour"));
}

TEST(OpenNiLiveSource, TakesTheNearestModeAndSaysSo) {
  Stream stream({}, OpenNiParams{});
  ASSERT_TRUE(stream.reader.frame());
  EXPECT_THAT(stream.reader.notices, HasSubstr("has no depth of 640x480 at 30 Hz; it runs 160x120 at 30 Hz"));
}

TEST(OpenNiLiveSource, AnUprightModeIsNotTheNearest) {
  Stream stream(Settings{{"upright", "1"}});
  ASSERT_TRUE(stream.reader.frame());
  EXPECT_THAT(stream.reader.notices, HasSubstr("160x120 at 30 Hz, 1 mm"));
  EXPECT_THAT(stream.reader.notices, Not(HasSubstr("120x160")));
}

TEST(OpenNiLiveSource, FindsTheSensorThatIsMeant) {
  Stream stream(Settings{{"second_uri", "virtual/2@7"}}, Stream::sized(), "@7");
  ASSERT_TRUE(stream.reader.frame());
  stream.sensor.unplug();  // the other sensor
  EXPECT_GT(stream.reader.frames_within(std::chrono::milliseconds(500)), 0);
  EXPECT_THAT(stream.reader.notices, Not(HasSubstr("unplugged")));
}

TEST(OpenNiLiveSource, WaitsForASensorThatIsNotThereYetAndNamesTheOthers) {
  Stream stream({}, Stream::sized(), "1d27/0601");
  EXPECT_TRUE(stream.reader.told("no sensor with 1d27/0601 in its address yet; there are: virtual/1"));
  EXPECT_EQ(stream.reader.delivered, 0);
}

TEST(OpenNiDevices, AreListed) {
  VirtualSensor sensor(Settings{{"second_uri", "virtual/2"}});
  const auto devices = list_openni_devices();
  ASSERT_TRUE(devices.has_value()) << devices.error().message();
  ASSERT_EQ(devices->size(), 2u);
  EXPECT_EQ((*devices)[0].uri, "virtual/1");
  EXPECT_EQ((*devices)[0].vendor, "Barehand");
  EXPECT_EQ((*devices)[0].name, "Virtual Sensor");
  EXPECT_EQ((*devices)[1].uri, "virtual/2");
}

TEST(OpenNiDevices, AreListedWithoutMovingOtherThreadsToAnotherFolder) {
  VirtualSensor sensor;
  const std::string here = std::filesystem::current_path();
  std::atomic<bool> done = false, moved = false;
  std::thread other([&] {
    while (!done)
      if (std::filesystem::current_path() != here) moved = true;
  });
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(list_openni_devices());
  done = true;
  other.join();
  EXPECT_FALSE(moved);
}

}  // namespace
}  // namespace barehand
