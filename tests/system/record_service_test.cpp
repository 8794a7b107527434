// Tests `barehand record` as a service that never ends: when it is killed, on a full disk, and with rotated files.
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <thread>

#include "drivers/lcm/lcm_log_source.h"
#include "support/barehand_program.h"
#include "support/temp_folder.h"
#include "system/notify_socket.h"
#include "system/small_disk.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kLiveHand = "sim:fist,live=true,loop=true,width=160,height=120";

class Record : public ::testing::Test {
 protected:
  std::vector<std::string> command(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {BAREHAND_PROGRAM, "record", "--source", kLiveHand, "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  static Outcome run(const std::vector<std::string>& command) {
    ChildProcess child(command);
    const int exit_code = child.finish();
    return {exit_code, child.output()};
  }
  static std::vector<fs::path> logs(const fs::path& folder) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
  }
  /// Numbers of the frames in a log, all events of which must be frames.
  static std::vector<std::int64_t> replay(const fs::path& path) {
    std::vector<std::int64_t> numbers;
    auto source = LcmLogSource::open(path.string());
    if (!source) return numbers;
    for (SourceEvent event = (*source)->next({}); !std::holds_alternative<EndOfStream>(event);
         event = (*source)->next({})) {
      EXPECT_TRUE(std::holds_alternative<FramePtr>(event));
      if (const auto* frame = std::get_if<FramePtr>(&event)) numbers.push_back((*frame)->number);
    }
    return numbers;
  }
  const test::TempFolder folder_;
};

TEST_F(Record, AKilledRecordingReplaysUpToTheLastFrame) {
  const std::string log = folder_ / "a.lcmlog.unfinished";
  for (int i = 0; i < 5; ++i) {  // killed at different moments
    ChildProcess child(command(folder_ / "a.lcmlog"));
    const auto enough = static_cast<std::uintmax_t>(50'000 + 17'000 * i);
    std::error_code not_yet;
    for (std::uintmax_t size = 0; size == static_cast<std::uintmax_t>(-1) || size < enough;
         size = fs::file_size(log, not_yet))
      std::this_thread::yield();
    child.signal(SIGKILL);
    EXPECT_EQ(child.finish(), 128 + SIGKILL);
    const auto reader = LcmLogReader::open(log);
    ASSERT_TRUE(reader) << reader.error().message();
    const auto numbers = replay(log);
    EXPECT_EQ(numbers.size(), reader->entries().size());
    ASSERT_FALSE(numbers.empty());
    std::int64_t largest = 0;
    for (const LogEntry& entry : reader->entries()) largest = std::max<std::int64_t>(largest, entry.size + 64);
    EXPECT_LT(reader->damaged_bytes(), 2 * largest) << "more than one frame is torn";
    fs::remove(log);
  }
}

TEST_F(Record, ASetIsWithinItsQuotaAndEachFileReplays) {
  ChildProcess child(command(folder_ / "set/take.lcmlog", {"--max-size", "60kB", "--quota", "200kB"}));
  const auto newest = [&] {
    std::error_code not_yet;
    if (!fs::exists(folder_ / "set", not_yet)) return std::string();
    const auto paths = logs(folder_ / "set");
    return paths.empty() ? std::string() : paths.back().filename().string();
  };
  while (newest() < "take-000008") std::this_thread::sleep_for(std::chrono::milliseconds(20));
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), HasSubstr("take-*.lcmlog, of which the oldest "));
  std::uintmax_t bytes = 0;
  std::int64_t last = -1;
  for (const fs::path& path : logs(folder_ / "set")) {
    bytes += fs::file_size(path);
    const auto numbers = replay(path);
    ASSERT_FALSE(numbers.empty()) << path;
    EXPECT_GT(numbers.front(), last) << "files are in the order of their names";
    last = numbers.back();
  }
  EXPECT_LE(bytes, 200'000u);
  EXPECT_EQ(replay(folder_ / "set").back(), last) << "a folder plays its files one after the other";
  EXPECT_GT(replay(folder_ / "set").size(), replay(logs(folder_ / "set").back()).size());
  EXPECT_GT(logs(folder_ / "set").front().filename().string(), "take-000002") << "the oldest made room";
}

TEST_F(Record, TellsSystemdHowItGoes) {
  NotifySocket socket("2000000");
  ChildProcess child(command(folder_ / "a.lcmlog"));
  EXPECT_FALSE(socket.wait_for("READY=1").empty());
  EXPECT_FALSE(socket.wait_for("WATCHDOG=1").empty());
  EXPECT_THAT(socket.wait_for("STATUS"), HasSubstr("frames written to LCM log"));
  child.signal(SIGTERM);
  EXPECT_FALSE(socket.wait_for("STOPPING=1").empty());
  EXPECT_EQ(child.finish(), 0) << child.output();
}

TEST_F(Record, ASecondRecorderOfTheSameSetIsRefused) {
  const std::vector<std::string> of_a_set = {"--max-size", "60kB", "--quota", "200kB"};
  ChildProcess first(command(folder_ / "set/take.lcmlog", of_a_set));
  while (replay(folder_ / "set").empty()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const Outcome second = run(command(folder_ / "set/take.lcmlog", of_a_set));
  EXPECT_EQ(second.exit_code, 1) << "systemd starts it again";
  EXPECT_THAT(second.output, HasSubstr("is held by process " + std::to_string(first.pid()) + " on "));
  std::vector<std::string> other = of_a_set;
  other.insert(other.end(), {"--frames", "2"});
  EXPECT_EQ(run(command(folder_ / "set/other.lcmlog", other)).exit_code, 0) << "another set in the same folder";
  first.signal(SIGTERM);
  EXPECT_EQ(first.finish(), 0) << first.output();
  EXPECT_FALSE(fs::exists(folder_ / "set/.take.lcmlog.lock"));
}

TEST_F(Record, ARestartedRecorderWaitsForTheOneBeforeIt) {
  ChildProcess first(command(folder_ / "set/take.lcmlog", {"--max-size", "60kB"}));
  while (!fs::exists(folder_ / "set/.take.lcmlog.lock")) sched_yield();
  ChildProcess second(command(folder_ / "set/take.lcmlog", {"--max-size", "60kB", "--frames", "2"}));
  first.signal(SIGTERM);
  EXPECT_EQ(first.finish(), 0) << first.output();
  EXPECT_EQ(second.finish(), 0) << second.output();
}

TEST_F(Record, RefusesASetThatCannotBe) {
  const auto expect_refusal = [&](const std::string& out, const std::vector<std::string>& more, const char* why) {
    const Outcome outcome = run(command(folder_ / out, more));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, HasSubstr(why));
  };
  expect_refusal("a.lcmlog", {"--max-size", "1GB", "--quota", "1GB"}, "is smaller than two files");
  expect_refusal("folder", {"--max-age", "1h"}, "only an LCM log can continue in new files");
  expect_refusal("a.lcmlog", {"--max-age", "1 fortnight"}, "fortnight");
}

/// Tests recording to a small disk.
class RecordOnSmallDisk : public Record {
 protected:
  void SetUp() override {
    if (!SmallDisk::possible()) GTEST_SKIP() << "no mount namespaces here";
  }
  std::vector<std::string> on_small_disk(const std::vector<std::string>& more) const {
    return disk_.command(command(folder_ / "take.lcmlog", more));
  }
  const SmallDisk disk_{folder_.path()};
};

TEST_F(RecordOnSmallDisk, RecordingGoesOnWhenThereIsRoomAgain) {
  const test::TempFolder outside;  // outside of the folder that the small disk is mounted on
  ChildProcess child(on_small_disk({}));
  ASSERT_TRUE(child.wait_for("No space left on device")) << child.output();
  disk_.make_room(child);
  ASSERT_TRUE(child.wait_for("writing again")) << child.output();
  disk_.beside(child, "cp " + (folder_ / "take.lcmlog.unfinished") + " " + (outside / "copy.lcmlog"));
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), HasSubstr(" lost: cannot write the log: No space left on device"));
  const auto numbers = replay(outside / "copy.lcmlog");
  ASSERT_GT(numbers.size(), 2u);
  EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
}

TEST_F(RecordOnSmallDisk, TheOldestOfASetMakeRoomForTheNewest) {
  ChildProcess child(on_small_disk({"--max-size", "40kB", "--quota", "1GB"}));
  ASSERT_TRUE(child.wait_for("\n"));  // after its first line, the disk is mounted
  const auto newest = [&] { return disk_.beside(child, "ls " + folder_.path() + " | grep take | tail -n 1"); };
  for (std::string name = newest(); name < "take-000012"; name = newest())
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::string oldest = disk_.beside(child, "ls " + folder_.path() + " | grep take | head -n 1");
  EXPECT_GT(oldest, "take-000002");
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_EQ(child.output().find("lost"), std::string::npos) << child.output();
}

}  // namespace
}  // namespace barehand
