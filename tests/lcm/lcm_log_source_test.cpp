#include "drivers/lcm/lcm_log_source.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <lcm/lcm-cpp.hpp>

#include "barehand/command_t.hpp"
#include "drivers/lcm/frame_codec.h"
#include "drivers/lcm/layouts.h"
#include "foreign_messages.h"
#include "io/lcm/lcm_log_writer.h"
#include "support/resource_limit.h"
#include "support/temp_folder.h"
#include "test_frames.h"

namespace barehand {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes frame_bytes(std::int64_t number) { return encode_message(encode_frame(test_frame(number), {}).value()); }

class LcmLog : public testing::Test {
 protected:
  /// Appends an event to the log file, which can be read at the same time.
  void append(const std::string& channel, const Bytes& message) {
    if (!writer_) writer_ = std::make_unique<lcm::LogFile>(path_, "w");
    lcm::LogEvent event;
    event.timestamp = 42;
    event.channel = channel;
    event.datalen = static_cast<std::int32_t>(message.size());
    event.data = const_cast<std::uint8_t*>(message.data());
    ASSERT_EQ(writer_->writeEvent(&event), 0);
    ASSERT_EQ(std::fflush(writer_->getFilePtr()), 0);
  }
  void append_frames(int count, const std::string& channel = "RGBD_FRAME") {
    for (int i = 0; i < count; ++i) append(channel, frame_bytes(100 + i));
  }
  /// The events that the source delivers, such as "100 101 skip end".
  std::string play(const LcmLogOptions& options = {}) {
    auto source = LcmLogSource::open(path_, options);
    if (!source) return source.error().message();
    std::string text;
    for (std::int64_t left = (*source)->remaining();; --left) {
      EXPECT_EQ((*source)->remaining(), std::max<std::int64_t>(left, 0));
      const SourceEvent event = (*source)->next(std::chrono::milliseconds(0));
      if (const auto* frame = std::get_if<FramePtr>(&event)) text += std::to_string((*frame)->number) + " ";
      if (std::holds_alternative<SkippedFrame>(event)) text += "skip ";
      if (std::holds_alternative<SourceFailed>(event)) return text + "failed";
      if (std::holds_alternative<EndOfStream>(event)) return text + "end";
    }
  }
  Bytes file() const {
    std::ifstream in(path_, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(in), {});
  }
  void replace_file(const Bytes& bytes) {
    writer_.reset();
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

  test::TempFolder folder_;
  std::string path_ = folder_ / "test.lcmlog";
  std::unique_ptr<lcm::LogFile> writer_;
};

TEST_F(LcmLog, ReplaysFramesUnchanged) {
  append_frames(2);
  auto source = LcmLogSource::open(path_).value();
  EXPECT_FALSE(source->live());
  for (const int number : {100, 101}) {
    const SourceEvent event = source->next(std::chrono::milliseconds(0));
    expect_same_frame(*std::get<FramePtr>(event), test_frame(number));
  }
}

TEST_F(LcmLog, TheRateIsThatOfTheTimes) {
  append_frames(1);
  EXPECT_EQ(LcmLogSource::open(path_).value()->fps(), 0) << "it is not known";
  for (const int number : {101, 102, 150}) append("RGBD_FRAME", frame_bytes(number));
  EXPECT_EQ(LcmLogSource::open(path_).value()->fps(), 30) << "the pause does not count";
}

TEST_F(LcmLog, StartAndStepChooseFrames) {
  append_frames(6);
  EXPECT_EQ(play(), "100 101 102 103 104 105 end");
  EXPECT_EQ(play({.start = 4}), "104 105 end");
  EXPECT_EQ(play({.start = 1, .step = 2}), "101 103 105 end");
  EXPECT_EQ(play({.step = -1}), "105 104 103 102 101 100 end");
  EXPECT_EQ(play({.start = 3, .step = -2}), "103 101 end");
}

TEST_F(LcmLog, ASenselessStartOrStepIsAnError) {
  append_frames(2);
  EXPECT_NE(play({.start = 2}).find("frames 0 to 1"), std::string::npos);
  EXPECT_NE(play({.start = -1}).find("no frame -1"), std::string::npos);
  EXPECT_NE(play({.step = 0}).find("step of 0"), std::string::npos);
}

TEST_F(LcmLog, OtherChannelsAreLeftOut) {
  append("COMMAND", encode_message(command_t{}));
  append_frames(2);
  EXPECT_EQ(play(), "100 101 end");
}

TEST_F(LcmLog, AGlobChoosesTheChannel) {
  append_frames(1, "LEFT_RGBD_FRAME");
  append("RIGHT_RGBD_FRAME", frame_bytes(200));
  EXPECT_EQ(play({.channel = "RIGHT*"}), "200 end");
  EXPECT_EQ(play({.channel = "LEFT_RGBD_FRAME"}), "100 end");
}

TEST_F(LcmLog, SeveralChannelsWithFramesNeedAChoice) {
  append_frames(1, "LEFT_RGBD_FRAME");
  append_frames(1, "RIGHT_RGBD_FRAME");
  append_frames(1, "OTHER");
  for (const char* pattern : {"", "*RGBD_FRAME"}) {
    const std::string message = play({.channel = pattern});
    EXPECT_NE(message.find("\"LEFT_RGBD_FRAME\", "), std::string::npos) << message;
    EXPECT_NE(message.find("\"RIGHT_RGBD_FRAME\""), std::string::npos) << message;
  }
}

TEST_F(LcmLog, AChannelThatIsNotThereNamesThoseThatAre) {
  append_frames(1);
  append("COMMAND", encode_message(command_t{}));
  const std::string message = play({.channel = "KINECT*"});
  EXPECT_NE(message.find("\"COMMAND\", \"RGBD_FRAME\""), std::string::npos) << message;
}

TEST_F(LcmLog, ALogWithoutFramesNamesItsChannels) {
  append("COMMAND", encode_message(command_t{}));
  EXPECT_NE(play().find("channels are \"COMMAND\""), std::string::npos);
}

TEST_F(LcmLog, WrongTypesAndDamagedMessagesAreSkipped) {
  append("CAMERA", frame_bytes(100));
  append("CAMERA", encode_message(command_t{}));
  append("CAMERA", {});
  Bytes damaged = frame_bytes(101);
  damaged.resize(damaged.size() - 3);
  append("CAMERA", damaged);
  append("CAMERA", frame_bytes(102));
  EXPECT_EQ(play({.channel = "CAMERA"}), "100 skip skip skip 102 end");
}

TEST_F(LcmLog, RepeatedAndOutdatedFramesAreSkipped) {
  for (const int number : {100, 101, 101, 99, 102}) append("RGBD_FRAME", frame_bytes(number));
  EXPECT_EQ(play(), "100 101 skip skip 102 end");
  EXPECT_EQ(play({.step = -1}), "102 skip skip 101 100 end");
}

TEST_F(LcmLog, AClockThatWasSetBackIsANewStart) {
  for (const int number : {100, 101, 1, 2, 1, 3}) append("RGBD_FRAME", frame_bytes(number));
  EXPECT_EQ(play(), "100 101 102 103 skip 104 end") << "numbers go on";
  EXPECT_EQ(play({.step = -1}), "104 skip 103 102 101 100 end");
  const auto source = LcmLogSource::open(path_).value();
  ASSERT_EQ(source->warnings().size(), 2u) << "and one frame of six is out of order";
  EXPECT_NE(source->warnings()[0].find("new start"), std::string::npos);
}

TEST_F(LcmLog, NumbersGoOnOverASetOfLogsWhoseRecorderWasStartedAgain) {
  for (const auto& [name, start] : {std::pair("take-1.lcmlog", 0), std::pair("take-2.lcmlog", 60)}) {
    const auto log = LcmLogWriter::create(folder_ / name, false).value();
    for (int i = 0; i < 3; ++i) {
      RgbdFrame frame = test_frame(i);
      frame.utime += start * 1'000'000;
      ASSERT_TRUE(log->send("RGBD_FRAME", encode_message(encode_frame(frame, {}).value()), frame.utime));
    }
  }
  path_ = folder_.path();
  EXPECT_EQ(play(), "0 1 2 3 4 5 end");
  EXPECT_EQ(play({.start = 4}), "4 5 end") << "a number does not depend on where play starts";
  EXPECT_EQ(play({.step = -2}), "5 3 1 end");
  EXPECT_TRUE(LcmLogSource::open(path_).value()->warnings().empty());
}

TEST_F(LcmLog, TimesInAnotherUnitAreNamed) {
  for (int i = 0; i < 5; ++i) {
    RgbdFrame frame = test_frame(i);
    frame.utime = 1'700'000'000'000 + 33 * i;
    append("RGBD_FRAME", encode_message(encode_frame(frame, {}).value()));
  }
  EXPECT_EQ(play(), "0 1 2 3 4 end");
  const auto source = LcmLogSource::open(path_).value();
  ASSERT_EQ(source->warnings().size(), 1u);
  EXPECT_NE(source->warnings()[0].find("milliseconds"), std::string::npos) << source->warnings()[0];

  RgbdFrame frame = test_frame(5);
  frame.utime = 1'700'000'000'000'000'000;
  append("RGBD_FRAME", encode_message(encode_frame(frame, {}).value()));
  EXPECT_EQ(play(), "0 1 2 3 4 skip end") << "nanoseconds since the epoch are no microseconds";
}

TEST_F(LcmLog, EveryTruncationReplaysTheWholeEvents) {
  append_frames(2);
  const Bytes whole = file();
  const auto second = static_cast<std::size_t>(LcmLogReader::open(path_)->entries()[1].position);
  for (std::size_t size = second; size < whole.size(); size += 101) {
    replace_file(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    EXPECT_EQ(play(), "100 end") << size;
    EXPECT_EQ(LcmLogReader::open(path_)->damaged_bytes(), static_cast<std::int64_t>(size - second));
  }
}

TEST_F(LcmLog, DamageInTheMiddleCostsOnlyTheEventItHits) {
  append_frames(3);
  Bytes bytes = file();
  bytes[static_cast<std::size_t>(LcmLogReader::open(path_)->entries()[1].position)] ^= 0xFF;
  replace_file(bytes);
  EXPECT_EQ(play(), "100 102 end");
}

TEST_F(LcmLog, ATornEventDoesNotTakeThoseBehindItAlong) {
  append_frames(3);
  append("OTHER", {1, 2, 3});
  const Bytes whole = file();
  const auto third = static_cast<std::ptrdiff_t>(LcmLogReader::open(path_)->entries()[2].position);
  for (const int missing : {1, 10, 60}) {
    Bytes bytes = whole;
    bytes.erase(bytes.begin() + third - missing, bytes.begin() + third);
    replace_file(bytes);
    EXPECT_EQ(play(), "100 102 end") << missing;
    EXPECT_EQ(LcmLogReader::open(path_)->entries().size(), 3u);
  }
  Bytes bytes = whole;
  bytes[static_cast<std::size_t>(third)] ^= 0xFF;  // the damage follows the second frame, which is complete
  replace_file(bytes);
  EXPECT_EQ(play(), "100 101 end");
}

TEST_F(LcmLog, LyingLengthsAreNoEvents) {
  append_frames(3);
  const Bytes whole = file();
  const auto second = static_cast<std::size_t>(LcmLogReader::open(path_)->entries()[1].position);
  for (const std::size_t length : {20u, 24u}) {
    for (const std::uint8_t high : {0x7F, 0x80, 0xFF}) {
      Bytes bytes = whole;
      bytes[second + length] = high;
      replace_file(bytes);
      EXPECT_EQ(play(), "100 102 end") << length;
    }
  }
}

TEST_F(LcmLog, FilesThatAreNoLogsAreRejected) {
  replace_file({});
  EXPECT_NE(play().find("empty"), std::string::npos);
  replace_file(Bytes(100'000, 'x'));
  EXPECT_NE(play().find("is not an LCM log"), std::string::npos);
  path_ = folder_ / "empty";
  std::filesystem::create_directory(path_);
  EXPECT_NE(play().find("holds no LCM logs"), std::string::npos);
  path_ = folder_ / "missing.lcmlog";
  EXPECT_NE(play().find("No such file"), std::string::npos);
}

TEST_F(LcmLog, AFolderPlaysItsLogsInTheOrderOfTheirNames) {
  for (const auto& [name, number] : {std::pair("b.lcmlog", 3), std::pair("a.lcmlog", 1)}) {
    const auto log = LcmLogWriter::create(folder_ / name, false).value();
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(log->send("RGBD_FRAME", frame_bytes(number + i), 42));
  }
  std::ofstream(folder_ / "c.lcmlog");  // a log whose recorder was killed before the first event
  std::ofstream(folder_ / "notes.txt") << "no log";
  path_ = folder_.path();
  EXPECT_EQ(play(), "1 2 3 4 end");
  EXPECT_EQ(play({.start = 2, .step = -1}), "3 2 1 end");
}

TEST_F(LcmLog, AFolderPlaysOnWhereALogHoldsNoWholeEvent) {
  append_frames(2);
  test::write_text(folder_ / "torn.lcmlog", "\xED\xA1\xDA\x01 power cut");
  path_ = folder_.path();
  EXPECT_EQ(play(), "100 101 end");
  const auto source = LcmLogSource::open(path_).value();
  ASSERT_EQ(source->left_out().size(), 1u);
  EXPECT_NE(source->left_out().front().message().find("torn.lcmlog: is not an LCM log"), std::string::npos);
}

TEST_F(LcmLog, AFolderPlaysWhatAKilledRecorderLeft) {
  for (const std::string name : {"1.lcmlog", "2.lcmlog.unfinished", "3.lcmlog"}) {
    path_ = folder_ / name;
    append("RGBD_FRAME", frame_bytes(100 + name.front()));
    writer_.reset();
  }
  path_ = folder_.path();
  EXPECT_EQ(play(), "149 150 151 end");
  const auto source = LcmLogSource::open(path_).value();
  ASSERT_EQ(source->warnings().size(), 1u);
  EXPECT_NE(source->warnings().front().find("2.lcmlog.unfinished: was left by a killed recorder"), std::string::npos);

  // When the recorder is started again, it gives the unfinished log its final name.
  std::filesystem::rename(folder_ / "2.lcmlog.unfinished", folder_ / "2.lcmlog");
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(std::holds_alternative<FramePtr>(source->next(std::chrono::milliseconds(0)))) << i;
}

TEST_F(LcmLog, WhereOnlyALivingRecorderWritesThatIsSaid) {
  const auto writer = LcmLogWriter::create(path_, false).value();
  ASSERT_TRUE(writer->send("RGBD_FRAME", frame_bytes(100), 1));
  path_ = folder_.path();
  EXPECT_NE(play().find("test.lcmlog.unfinished: is still being written"), std::string::npos) << play();
}

TEST_F(LcmLog, AFolderPlaysOnWhereAFileIsNoLog) {
  append_frames(2);
  test::write_text(folder_ / "a.log", "Starting the build\n");
  std::filesystem::create_symlink("/proc/self/mem", folder_ / "b.lcmlog");  // cannot be read
  test::write_text(folder_ / "c.lcmlog", std::string(5000, '\0'));
  path_ = folder_.path();
  EXPECT_EQ(play(), "100 101 end");
  EXPECT_EQ(LcmLogSource::open(path_).value()->left_out().size(), 2u);
  std::filesystem::remove(folder_ / "test.lcmlog");
  EXPECT_NE(play().find("a.log: is not an LCM log"), std::string::npos);
}

TEST_F(LcmLog, ASetOfLcmLoggerPlaysInItsOrder) {
  int number = 1;
  for (const char* name : {"old.2", "old.1", "old.0", "other.lcmlog", "take.lcmlog.00", "take.lcmlog.01"}) {
    const auto log = LcmLogWriter::create(folder_ / name, false).value();
    ASSERT_TRUE(log->send("RGBD_FRAME", frame_bytes(number++), 42));
  }
  path_ = folder_ / "take.lcmlog";
  EXPECT_EQ(play(), "5 6 end");
  path_ = folder_ / "old";
  EXPECT_EQ(play(), "1 2 3 end");
  path_ = folder_.path();
  EXPECT_EQ(play(), "1 2 3 4 5 6 end");
}

TEST_F(LcmLog, AChannelsNameIsItselfWhateverIsInIt) {
  const std::vector<std::string> names = {"cam[0]_F",
                                          "left cam F",
                                          "/depth(1)+F",
                                          "gr\xc3\xb6\xc3\x9f"
                                          "eF",
                                          "a?b*F",
                                          "axb_F",
                                          "{$}^|.F",
                                          "back\\slash"};
  for (std::size_t i = 0; i < names.size(); ++i) append(names[i], frame_bytes(static_cast<std::int64_t>(i)));
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(play({.channel = names[i]}), std::to_string(i) + " end");
  EXPECT_EQ(play({.channel = "cam[0]*"}), "0 end");
  EXPECT_EQ(play({.channel = "a?b_F"}), "5 end");
  const std::string message = play();
  EXPECT_NE(message.find("run.frame_channel: \"/depth(1)+F\""), std::string::npos) << message;
  EXPECT_NE(message.find("--channel '/depth(1)+F'"), std::string::npos) << message;
}

TEST_F(LcmLog, AFolderMayHoldMoreLogsThanMayBeOpen) {
  const test::ResourceLimit limit(RLIMIT_NOFILE, 64);
  std::string all;
  for (int number = 100; number < 200; ++number) {
    const auto log = LcmLogWriter::create(folder_ / (std::to_string(number) + ".lcmlog"), false).value();
    ASSERT_TRUE(log->send("RGBD_FRAME", frame_bytes(number), 42));
    all += std::to_string(number) + " ";
  }
  path_ = folder_.path();
  EXPECT_EQ(play(), all + "end");
}

TEST_F(LcmLog, ForeignFramesReplayWithGivenIntrinsics) {
  append("KINECT_FRAME", encode_message(kinect_message(test_frame(1), true)));
  append("KINECT_FRAME", encode_message(kinect_message(test_frame(2), true)));
  EXPECT_EQ(play({.foreign = {50, 50, 20, 15}}), "0 1 end") << "foreign frames are numbered by their place";
  EXPECT_EQ(play(), "skip skip end") << "without intrinsics there is no frame";
}

TEST_F(LcmLog, ALogThatShrinksWhileItIsReadFailsClearly) {
  append("CAMERA", Bytes(100'000, 1));  // more than a read buffer holds
  auto source = LcmLogSource::open(path_, {.channel = "CAMERA"}).value();
  replace_file({});
  EXPECT_TRUE(std::holds_alternative<SourceFailed>(source->next(std::chrono::milliseconds(0))));
}

}  // namespace
}  // namespace barehand
