// Tests how the source reacts to faults of the virtual sensor that start while it streams.
#include <gmock/gmock.h>

#include <atomic>

#include "drivers/openni2/openni_live_source.h"
#include "openni2/source_reader.h"
#include "openni2/virtual_sensor.h"

namespace barehand {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::Not;

/// A clock that can be set, like the system's clock.
class SettableClock : public SystemClock {
 public:
  std::int64_t utime() const override { return SystemClock::utime() + set_by; }
  std::atomic<std::int64_t> set_by = 0;  ///< offset from the system's clock [us]
};

class OpenNiFaults : public ::testing::Test {
 protected:
  void open(VirtualSensor::Settings settings = {}) {
    sensor_.set(settings);
    OpenNiParams params;
    params.width = 160;
    params.height = 120;
    params.reopen_after = 1;
    source_ = std::make_unique<OpenNiLiveSource>("", params, 64, clock_);
    reader_ = std::make_unique<SourceReader>(*source_);
  }
  void stream() {
    open();
    ASSERT_TRUE(reader_->frame([](const RgbdFrame& f) { return !f.colour.empty(); })) << reader_->notices;
    reader_->notices.clear();
  }
  void inject(const std::string& fault) { sensor_.set({{"fault", fault}}); }

  SettableClock clock_;
  VirtualSensor sensor_;
  std::unique_ptr<OpenNiLiveSource> source_;
  std::unique_ptr<SourceReader> reader_;
};

TEST_F(OpenNiFaults, AbsentAtStart) {
  open({{"plugged", "0"}});
  ASSERT_TRUE(reader_->told("no sensor yet (plug it in; barehand doctor"));
  EXPECT_EQ(reader_->delivered, 0);
  sensor_.plug();
  EXPECT_TRUE(reader_->frame());
}

TEST_F(OpenNiFaults, UnpluggedAndPluggedIntoAnotherPort) {
  stream();
  const FramePtr before = reader_->frame();
  sensor_.unplug();
  ASSERT_TRUE(reader_->told("virtual/1 was unplugged"));
  reader_->frames_within(milliseconds(100));  // read the frames that were already on their way
  EXPECT_EQ(reader_->frames_within(milliseconds(500)), 0);
  sensor_.set({{"plugged", "1"}, {"uri", "virtual/9"}});
  const FramePtr after = reader_->frame();
  ASSERT_TRUE(before && after);
  EXPECT_GT(after->number, before->number);
  EXPECT_GT(after->utime, before->utime + 500'000);
}

TEST_F(OpenNiFaults, CannotBeOpenedForAWhile) {
  open({{"fault", "open"}});
  ASSERT_TRUE(reader_->told("cannot be opened: virtual device: busy")) << reader_->notices;
  inject("none");
  EXPECT_TRUE(reader_->frame());
}

TEST_F(OpenNiFaults, StreamsDoNotStartForAWhile) {
  open({{"fault", "start"}});
  ASSERT_TRUE(reader_->told("the depth stream cannot be started"));
  inject("none");
  EXPECT_TRUE(reader_->frame());
}

TEST_F(OpenNiFaults, StallWithoutAnError) {
  stream();
  sensor_.set({{"fault", "stall"}, {"cured_by_reopen", "1"}});
  ASSERT_TRUE(reader_->told("stalled: no depth for"));
  EXPECT_TRUE(reader_->frame()) << "opening it again cures it";
}

TEST_F(OpenNiFaults, AHiccupOfBothCamerasIsNoReasonToDoubtThatTheyAreInStep) {
  stream();
  inject("stall");
  reader_->frames_within(milliseconds(750));  // more than half of the time until a stall is reported, but not all of it
  inject("none");
  reader_->frames(20);
  EXPECT_THAT(reader_->notices, Not(HasSubstr("synchronise")));
}

TEST_F(OpenNiFaults, ASlowStartIsNoReasonEither) {
  open({{"fault", "stall"}});
  ASSERT_TRUE(reader_->told("opened"));
  reader_->frames_within(milliseconds(2000));
  inject("none");
  reader_->frames(20);
  EXPECT_THAT(reader_->notices, Not(HasSubstr("not synchronised")));
}

/// Faults whose frames must not reach the tracker.
class Useless : public OpenNiFaults, public ::testing::WithParamInterface<std::pair<const char*, const char*>> {};
TEST_P(Useless, IsKeptBackSaidAndOpenedAgain) {
  stream();
  const auto [fault, words] = GetParam();
  sensor_.set({{"fault", fault}, {"cured_by_reopen", "1"}});
  const int skipped = reader_->skipped;
  ASSERT_TRUE(reader_->told(words)) << reader_->notices;
  EXPECT_GE(reader_->skipped, skipped + 10);
  EXPECT_TRUE(reader_->frame());
}
INSTANTIATE_TEST_SUITE_P(Kinds, Useless,
                         ::testing::Values(std::pair("garbage", "delivers noise instead of depth for"),
                                           std::pair("short", "delivers incomplete depth images for"),
                                           std::pair("frozen", "frozen: the same depth image for")),
                         [](const auto& test) { return std::string(test.param.first); });

TEST_F(OpenNiFaults, FrozenFramesAreNotDeliveredAgain) {
  stream();
  inject("frozen");
  reader_->frames_within(milliseconds(200));
  EXPECT_LE(reader_->frames_within(milliseconds(700)), 1);
}

TEST_F(OpenNiFaults, BlackFramesAreDeliveredAndSaid) {
  stream();
  inject("black");
  EXPECT_TRUE(reader_->told("no pixel has depth"));
  const FramePtr frame = reader_->frame();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(
      std::all_of(frame->depth.data(), frame->depth.data() + frame->depth.size(), [](auto d) { return d == 0; }));
  EXPECT_THAT(reader_->notices, Not(HasSubstr("opened")));
}

TEST_F(OpenNiFaults, BlackColour) {
  stream();
  inject("black_colour");
  EXPECT_TRUE(reader_->told("the colour image is black"));
  EXPECT_TRUE(reader_->frame());
}

class ColourStops : public OpenNiFaults, public ::testing::WithParamInterface<const char*> {};
TEST_P(ColourStops, DepthGoesOnAndColourIsWelcomeBack) {
  sensor_.set({{"sync", GetParam()}});
  stream();
  inject("no_colour");
  ASSERT_TRUE(reader_->told("no more colour images arrive; tracking continues"));
  for (const FramePtr& frame : reader_->frames(10)) EXPECT_TRUE(frame->colour.empty());
  inject("none");
  EXPECT_TRUE(reader_->told("colour images arrive again"));
  EXPECT_TRUE(reader_->frame([](const RgbdFrame& f) { return !f.colour.empty(); }));
  EXPECT_THAT(reader_->notices, Not(HasSubstr("opened")));
}
INSTANTIATE_TEST_SUITE_P(InStep, ColourStops, ::testing::Values("0", "1"));

class ClockJump : public OpenNiFaults, public ::testing::WithParamInterface<const char*> {};
TEST_P(ClockJump, IsSaidAndStampsGoOn) {
  stream();
  reader_->frames(30);
  const FramePtr before = reader_->frame();
  sensor_.set({{"clock_offset_us", GetParam()}});
  ASSERT_TRUE(reader_->told("the sensor's clock jumped by"));
  const FramePtr after = reader_->frame();
  ASSERT_TRUE(before && after);
  EXPECT_GT(after->utime, before->utime);
  EXPECT_LT(after->utime, before->utime + 20'000'000);
  EXPECT_LE(after->utime, clock_.utime());
}
INSTANTIATE_TEST_SUITE_P(Microseconds, ClockJump, ::testing::Values("-3000000", "60000000"),
                         [](const auto& test) { return test.param[0] == '-' ? "Back" : "Forward"; });

TEST_F(OpenNiFaults, TheMachinesClockIsSet) {
  stream();
  const FramePtr before = reader_->frame();
  ASSERT_TRUE(before);
  clock_.set_by = 3'600'000'000;
  ASSERT_TRUE(reader_->told("this machine's clock was set by +"));
  EXPECT_TRUE(reader_->frame([&](const RgbdFrame& f) { return f.utime > before->utime + clock_.set_by; }));
}

class Rate : public OpenNiFaults, public ::testing::WithParamInterface<int> {};
TEST_P(Rate, IsFollowed) {
  open({{"fps", std::to_string(GetParam())}});
  ASSERT_TRUE(reader_->frame());
  const FramePtr first = reader_->frame();
  const auto frames = reader_->frames(3 * GetParam());
  ASSERT_TRUE(first && !frames.empty());
  const double seconds = 1e-6 * static_cast<double>(frames.back()->utime - first->utime);
  const double exposed = static_cast<double>(frames.back()->number - first->number);
  EXPECT_NEAR(exposed / seconds, GetParam(), 0.05 * GetParam());
  EXPECT_THAT(reader_->notices, Not(HasSubstr("stalled")));
  EXPECT_THAT(reader_->notices, Not(HasSubstr("colour stopped")));
}
INSTANTIATE_TEST_SUITE_P(Hz, Rate, ::testing::Values(5, 120));

TEST_F(OpenNiFaults, ADriverThatHangsDoesNotHoldUpTheEnd) {
  stream();
  inject("hang");
  std::this_thread::sleep_for(milliseconds(100));
  const auto start = std::chrono::steady_clock::now();
  source_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
  inject("none");  // lets the thread that was left behind finish before OpenNI2 is used again
  std::this_thread::sleep_for(milliseconds(500));
}

TEST_F(OpenNiFaults, ManyPlugsCostNothing) {
  stream();
  const auto replug = [&](int times) {
    for (int i = 0; i < times; ++i) {
      sensor_.unplug();
      std::this_thread::sleep_for(milliseconds(60));
      reader_->frames_within(milliseconds(20));
      sensor_.plug();
      ASSERT_TRUE(reader_->frame()) << i;
    }
  };

  // Count open files and threads after the sensor was plugged in some times ...
  replug(5);
  const auto open_files = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  };
  const auto threads = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator());
  };
  const auto files = open_files(), tasks = threads();

  // ... and after many more.
  replug(15);
  EXPECT_LE(open_files(), files + 1);
  EXPECT_LE(threads(), tasks + 1);
}

}  // namespace
}  // namespace barehand
