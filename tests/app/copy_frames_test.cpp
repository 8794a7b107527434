#include "app/record/copy_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "drivers/folder/folder_source.h"
#include "drivers/lcm/lcm_log_source.h"
#include "support/temp_folder.h"
#include "tests/lcm/test_frames.h"

namespace barehand {
namespace {

/// Delivers given events.
class ListSource : public FrameSource {
 public:
  explicit ListSource(std::vector<SourceEvent> events, bool live = false) : events_(std::move(events)), live_(live) {}
  SourceEvent next(std::chrono::milliseconds) override {
    return next_ < events_.size() ? events_[next_++] : SourceEvent(EndOfStream{});
  }
  bool live() const override { return live_; }
  std::string name() const override { return "list"; }

 private:
  std::vector<SourceEvent> events_;
  bool live_;
  std::size_t next_ = 0;
};

SourceEvent frame_event(int number) { return std::make_shared<const RgbdFrame>(test_frame(number)); }

class CopyFrames : public testing::Test {
 protected:
  CopyResult copy(FrameSource& source, FrameWriter& writer, const CopyOptions& options = {}) {
    return copy_frames(source, writer, options, stop_, clock_, report_);
  }
  std::unique_ptr<FrameWriter> writer(const std::string& name) { return open_frame_writer(folder_ / name, {}).value(); }
  test::TempFolder folder_;
  std::atomic<bool> stop_ = false;
  ManualClock clock_;
  std::ostringstream report_;
};

/// Writes a given number of frames, then reports a full disk.
class FullDisk : public FrameWriter {
 public:
  explicit FullDisk(int frames) : left_(frames) {}
  Result<void> write(const RgbdFrame&) override {
    if (left_-- > 0) return {};
    return fail("No space left on device");
  }
  Result<void> finish() override { return {}; }
  std::string name() const override { return "full disk"; }

 private:
  int left_;
};

TEST_F(CopyFrames, FolderToLogToFolderKeepsEveryPixel) {
  ListSource source({frame_event(0), frame_event(1), frame_event(2)});
  EXPECT_EQ(copy(source, *writer("a")).written, 3);
  auto folder = FolderSource::open(folder_ / "a").value();
  EXPECT_EQ(copy(*folder, *writer("b.lcmlog")).written, 3);
  auto log = LcmLogSource::open(folder_ / "b.lcmlog").value();
  EXPECT_EQ(copy(*log, *writer("c")).written, 3);
  auto last = FolderSource::open(folder_ / "c").value();
  for (int number = 0; number < 3; ++number) {
    RgbdFrame expected = test_frame(number);
    expected.sensor = "";  // a recording folder does not store the sensor's name
    const SourceEvent event = last->next(std::chrono::milliseconds(0));
    expect_same_frame(*std::get<FramePtr>(event), expected);
  }
}

TEST_F(CopyFrames, NoticesOfTheSourceAreReported) {
  ListSource source({frame_event(0), SourceNotice{{"the sensor was unplugged", "", ""}}, frame_event(2)});
  EXPECT_EQ(copy(source, *writer("a")).written, 2);
  EXPECT_NE(report_.str().find("the sensor was unplugged"), std::string::npos);
}

TEST_F(CopyFrames, SaysLessAndLessOftenThatItWaits) {
  class AbsentSensor : public FrameSource {
   public:
    explicit AbsentSensor(ManualClock& clock) : clock_(clock) {}
    SourceEvent next(std::chrono::milliseconds) override {
      clock_.advance(1'000'000);
      return clock_.steady_us() < 200'000'000 ? SourceEvent(Timeout{}) : SourceEvent(EndOfStream{});
    }
    bool live() const override { return true; }
    std::string name() const override { return "absent"; }

   private:
    ManualClock& clock_;
  };
  AbsentSensor source(clock_);
  copy(source, *writer("a.lcmlog"));
  const std::string said = report_.str();
  EXPECT_EQ(std::ranges::count(said, '\n'), 3) << "at 3, 15 and 63 s\n" << said;
}

TEST_F(CopyFrames, SkippedFramesAreCountedAndReported) {
  ListSource source({frame_event(0), SkippedFrame{{"damaged", "frame 1", ""}}, frame_event(2)});
  const CopyResult result = copy(source, *writer("a.lcmlog"));
  EXPECT_EQ(result.written, 2);
  EXPECT_EQ(result.skipped, 1);
  EXPECT_NE(report_.str().find("frame 1: damaged"), std::string::npos) << report_.str();
}

TEST_F(CopyFrames, GapsInALiveSourceAreCounted) {
  ListSource live({frame_event(7), frame_event(8), frame_event(11)}, true);
  EXPECT_EQ(copy(live, *writer("a.lcmlog")).missing, 2);
  ListSource replay({frame_event(7), frame_event(11)});
  EXPECT_EQ(copy(replay, *writer("b.lcmlog")).missing, 0) << "its step may be 4";
}

TEST_F(CopyFrames, ASkippedFrameIsNotMissingAsWell) {
  const SkippedFrame skipped{{"noise", "", ""}};
  ListSource between({frame_event(7), skipped, frame_event(9), frame_event(10)}, true);
  EXPECT_EQ(copy(between, *writer("a.lcmlog")).missing, 0);
  ListSource early({skipped, frame_event(7), frame_event(9)}, true);
  EXPECT_EQ(copy(early, *writer("b.lcmlog")).missing, 0) << "it overtook frame 7, which waited";
  ListSource among({frame_event(7), skipped, frame_event(11)}, true);
  EXPECT_EQ(copy(among, *writer("c.lcmlog")).missing, 2);
}

TEST_F(CopyFrames, EverySensorOfALiveSourceCountsItsOwnFrames) {
  const auto of = [](const std::string& sensor, int number) {
    RgbdFrame frame = test_frame(number);
    frame.sensor = sensor;
    return SourceEvent(std::make_shared<const RgbdFrame>(frame));
  };
  ListSource live({of("left", 7), of("right", 5000), of("left", 8), of("right", 5002)}, true);
  EXPECT_EQ(copy(live, *writer("a.lcmlog")).missing, 1);
}

TEST_F(CopyFrames, AFullDiskEndsTheCopyWithAnError) {
  ListSource source({frame_event(0), frame_event(1), frame_event(2)});
  FullDisk disk(1);
  const CopyResult result = copy(source, disk);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.written, 1);
}

TEST_F(CopyFrames, ALiveCopyOutlivesAFullDisk) {
  class FullForAWhile : public FrameWriter {
   public:
    Result<void> write(const RgbdFrame& frame) override {
      if (frame.number == 1 || frame.number == 2) return fail("No space left on device");
      return {};
    }
    Result<void> finish() override { return {}; }
    std::string name() const override { return "disk"; }
  } disk;
  ListSource source({frame_event(0), frame_event(1), frame_event(2), frame_event(3)}, true);
  const CopyResult result = copy(source, disk);
  EXPECT_FALSE(result.error);
  EXPECT_EQ(result.written, 2);
  EXPECT_EQ(result.lost, 2);
  EXPECT_EQ(result.lost_why, "No space left on device");
  EXPECT_EQ(result.missing, 0);
  EXPECT_NE(report_.str().find("1 frames lost so far: No space left"), std::string::npos) << report_.str();
  EXPECT_NE(report_.str().find("writing again; 2 frames were lost"), std::string::npos) << report_.str();
}

TEST_F(CopyFrames, AFailingSourceKeepsWhatWasWritten) {
  ListSource source({frame_event(0), SourceFailed{{"unplugged", "", ""}}, frame_event(2)});
  const CopyResult result = copy(source, *writer("a.lcmlog"));
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->what, "unplugged");
  EXPECT_EQ(LcmLogSource::open(folder_ / "a.lcmlog").value()->remaining(), 1);
}

TEST_F(CopyFrames, StopsAtOnceWhenTold) {
  stop_ = true;
  ListSource source({frame_event(0)});
  const CopyResult result = copy(source, *writer("a.lcmlog"));
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.written, 0);
}

TEST_F(CopyFrames, TakesAsManyFramesAsAskedFor) {
  ListSource source({frame_event(0), frame_event(1), frame_event(2)});
  EXPECT_EQ(copy(source, *writer("a.lcmlog"), {.frames = 2}).written, 2);
}

TEST_F(CopyFrames, SaysHowFarItIs) {
  class Ticking : public ManualClock {
   public:
    std::int64_t steady_us() const override { return ticks_ += 10'000'000; }

   private:
    mutable std::int64_t ticks_ = 0;
  } ticking;
  ListSource source({frame_event(0), frame_event(1)});
  copy_frames(source, *writer("a.lcmlog"), {.expected = 2}, stop_, ticking, report_);
  EXPECT_NE(report_.str().find("2 of 2 frames"), std::string::npos) << report_.str();
}

TEST_F(CopyFrames, ColourCanBeLeftOut) {
  for (const char* name : {"a", "b.lcmlog"}) {
    ListSource source({frame_event(0)});
    auto writer = open_frame_writer(folder_ / name, {.encoding = {.colour = ColourEncoding::none}}).value();
    EXPECT_EQ(copy(source, *writer).written, 1);
  }
  const SourceEvent folder = FolderSource::open(folder_ / "a").value()->next(std::chrono::milliseconds(0));
  const SourceEvent log = LcmLogSource::open(folder_ / "b.lcmlog").value()->next(std::chrono::milliseconds(0));
  EXPECT_TRUE(std::get<FramePtr>(folder)->colour.empty());
  EXPECT_TRUE(std::get<FramePtr>(log)->colour.empty());
}

TEST_F(CopyFrames, WhereTheNameIsTakenMeanwhileTheDraftIsNamed) {
  for (const char* name : {"a.lcmlog", "a.mcap"}) {
    ListSource source({frame_event(0)});
    auto writer = open_frame_writer(folder_ / name, {}).value();
    EXPECT_EQ(copy(source, *writer).written, 1);
    EXPECT_TRUE(writer->name().ends_with(folder_ / name)) << writer->name();
    test::write_text(folder_ / name, "another run's");
    EXPECT_FALSE(writer->finish());
    EXPECT_TRUE(writer->name().ends_with(folder_ / name + ".unfinished")) << writer->name();
    EXPECT_GT(std::filesystem::file_size(folder_ / name + ".unfinished"), 1000u);
  }
}

TEST_F(CopyFrames, ExistingLogsAreRefused) {
  test::write_text(folder_ / "a.lcmlog", "somebody's");
  EXPECT_FALSE(open_frame_writer(folder_ / "a.lcmlog", {}));
  EXPECT_TRUE(open_frame_writer(folder_ / "a.lcmlog", {.overwrite = true}));
}

}  // namespace
}  // namespace barehand
