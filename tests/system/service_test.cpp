// Tests the program as a service of systemd: notifications, reloading, starting and stopping.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <regex>
#include <thread>

#include "io/hand/result_table.h"
#include "io/lcm/lcm_log_reader.h"
#include "pipeline/sinks/service_sink.h"
#include "support/barehand_program.h"
#include "support/quick_config.h"
#include "support/temp_folder.h"
#include "system/memory_limit.h"
#include "system/notify_socket.h"
#include "system/small_disk.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr const char* kLiveHand = "sim:fist,live=true,loop=true,width=160,height=120";

/// Calls the sink directly, with given counts of the pipeline's progress (its heartbeat), which decide whether the
/// watchdog is notified.
class Watchdog : public ::testing::Test {
 protected:
  bool fed() {
    clock_.advance(1'000'000);
    EXPECT_TRUE(sink_.idle());
    for (std::string message = socket_.next(); !message.empty(); message = socket_.next())
      if (message == "WATCHDOG=1") return true;
    return false;
  }
  NotifySocket socket_{"2000000"};
  ManualClock clock_;
  ServiceManager manager_{clock_};
  PipelineHeartbeat heartbeat_;
  ServiceSink sink_{manager_, [this] { return heartbeat_; }, [] { return PipelineHealth{}; },
                    [] { return std::vector<TrackStatus>{}; }, clock_};
};

TEST_F(Watchdog, IsFedWhileFramesPass) {
  for (int i = 0; i < 3; ++i) {
    heartbeat_ = {heartbeat_.answers + 1, heartbeat_.finished + 1, 1};
    EXPECT_TRUE(fed());
  }
}

TEST_F(Watchdog, IsFedWhileTheSourceSaysThatThereIsNoFrame) {
  for (int i = 0; i < 3; ++i) {
    ++heartbeat_.answers;
    EXPECT_TRUE(fed());
  }
}

TEST_F(Watchdog, StarvesWhenTheSourceHangs) {
  heartbeat_ = {7, 5, 0};
  EXPECT_TRUE(fed());
  EXPECT_FALSE(fed());
  EXPECT_FALSE(fed());
}

TEST_F(Watchdog, StarvesWhenAStageHangsThoughTheSourceAnswers) {
  heartbeat_ = {7, 5, 0};
  EXPECT_TRUE(fed());
  for (int i = 0; i < 3; ++i) {
    ++heartbeat_.answers;
    heartbeat_.inside = 1;
    EXPECT_FALSE(fed());
  }
}

TEST_F(Watchdog, IsFedNoOftenerThanItNeeds) {
  int messages = 0;
  for (int i = 0; i < 1000; ++i) {  // 10 s at 100 Hz
    clock_.advance(10'000);
    heartbeat_ = {i, i, 1};
    EXPECT_TRUE(sink_.idle());
    for (std::string message = socket_.next(); !message.empty(); message = socket_.next())
      messages += message == "WATCHDOG=1";
  }
  EXPECT_GE(messages, 10);
  EXPECT_LE(messages, 40);
}

TEST(ServiceManager, TellsTheFirstLineOfAText) {
  NotifySocket socket;
  const ManualClock clock;
  ServiceManager(clock).status("refused: key a\nWATCHDOG=1");
  EXPECT_EQ(socket.next(), "STATUS=refused: key a");
}

TEST(ServiceManager, KeepsStillWithoutSystemd) {
  const ManualClock clock;
  ServiceManager manager(clock);
  EXPECT_FALSE(manager.present());
  manager.ready("nobody hears it");
  manager.alive();
}

/// Runs `barehand track` with a simulated hand and a test configuration.
class Service : public ::testing::Test {
 protected:
  Service() { write_config(test::quick_config()); }
  void write_config(const std::string& text) const { test::write_text(config_, text); }
  void change(const std::string& from, const std::string& to) const {
    const std::string text = test::read_text(config_);
    const std::string changed = std::regex_replace(text, std::regex(from), to);
    ASSERT_NE(changed, text) << from;
    write_config(changed);
  }
  std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {BAREHAND_PROGRAM, "track", "--source",    kLiveHand,
                                          "--config",       config_, "--no-publish"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  NotifySocket socket_{"2000000"};
  const test::TempFolder folder_;
  const std::string config_ = folder_ / "config.yaml";
};

TEST_F(Service, TellsSystemdFromStartToStop) {
  ChildProcess child(command());
  EXPECT_THAT(socket_.next(60'000), HasSubstr("READY=1"));
  EXPECT_EQ(socket_.wait_for("WATCHDOG"), "WATCHDOG=1");
  EXPECT_THAT(socket_.wait_for("STATUS"), AllOf(HasSubstr("hand: "), HasSubstr("published")));
  child.signal(SIGTERM);
  EXPECT_THAT(socket_.wait_for("STOPPING"), HasSubstr("STOPPING=1"));
  EXPECT_EQ(child.finish(), 0) << child.output();
}

TEST_F(Service, IsAliveWhileItWaitsForASensor) {
  ChildProcess child({BAREHAND_PROGRAM, "track", "--source", "openni2", "--no-publish"});
  EXPECT_THAT(socket_.next(60'000), HasSubstr("READY=1"));
  EXPECT_EQ(socket_.wait_for("WATCHDOG"), "WATCHDOG=1");
  EXPECT_EQ(socket_.wait_for("WATCHDOG"), "WATCHDOG=1");
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
}

TEST_F(Service, RefusesABrokenConfigurationAndGoesOnWithTheOldOne) {
  ChildProcess child(command({"--health"}));
  ASSERT_TRUE(child.wait_for("captured ")) << child.output();
  write_config("run:\n  sed: 1\n");
  child.signal(SIGHUP);
  EXPECT_FALSE(socket_.wait_for("RELOADING=1").empty());
  EXPECT_THAT(socket_.wait_for("READY=1"), HasSubstr("STATUS=configuration not reloaded"));
  ASSERT_TRUE(child.wait_for("the old one stays in force"));
  const auto told = child.output().size();
  while (child.output().find("captured ", told) == std::string::npos)  // wait until frames are still processed
    ASSERT_TRUE(child.wait_for_more()) << child.output();
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), AllOf(HasSubstr("unknown key 'run.sed'"), HasSubstr(" 0 failed")));
}

TEST_F(Service, DoesNotTakeAShippedConfigurationForOneThatIsGone) {
  test::write_text(folder_ / "default.yaml", test::quick_config());
  ChildProcess child({"sh", "-c",
                      "cd '" + folder_.path() +
                          "'; exec " BAREHAND_PROGRAM " track --config default.yaml --no-publish --source " +
                          std::string(kLiveHand)});
  EXPECT_FALSE(socket_.wait_for("READY=1").empty());
  std::filesystem::remove(folder_ / "default.yaml");
  child.signal(SIGHUP);
  EXPECT_FALSE(socket_.wait_for("RELOADING=1").empty());
  EXPECT_THAT(socket_.wait_for("READY=1"), HasSubstr("STATUS=configuration not reloaded"));
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
}

TEST_F(Service, ReloadsWhatCanChangeAndSaysWhatCannot) {
  ChildProcess child(command());
  EXPECT_FALSE(socket_.wait_for("READY=1").empty());
  change(" levels: [0-9]+", " levels: 2");
  change(" seed: 1", " seed: 7");
  child.signal(SIGHUP);
  EXPECT_FALSE(socket_.wait_for("RELOADING=1").empty());
  EXPECT_THAT(socket_.wait_for("READY=1"), HasSubstr("STATUS=configuration reloaded"));
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_THAT(child.output(), AllOf(HasSubstr("changed tracker.fusion.levels: "), HasSubstr(" -> 2\n"),
                                    HasSubstr("takes effect only after a restart: run.seed: 1 -> 7")));
}

TEST_F(Service, LeavesNothingBehindWhenStartedAndStoppedAgainAndAgain) {
  const std::string here = folder_ / "here";
  fs::create_directory(here);
  setenv("TMPDIR", here.c_str(), 1);
  for (int cycle = 0; cycle < 6; ++cycle) {
    ChildProcess child(command({"--states-log", here + "/states.lcmlog"}));
    if (cycle % 2 == 0) {  // in every second cycle, the program is stopped while it starts
      EXPECT_FALSE(socket_.wait_for("WATCHDOG").empty());
    } else {
      EXPECT_FALSE(socket_.wait_for("READY=1").empty());
    }
    child.signal(SIGTERM);
    ASSERT_EQ(child.finish(), 0) << cycle << ": " << child.output();
    while (!socket_.next().empty()) {
    }
  }
  unsetenv("TMPDIR");
  for (const auto& entry : fs::directory_iterator(here)) {
    const std::string name = entry.path().filename();
    EXPECT_TRUE(std::regex_match(name, std::regex("states(-[2-6])?\\.lcmlog"))) << name;
    const auto log = LcmLogReader::open(entry.path());
    EXPECT_TRUE(log && log->damaged_bytes() == 0) << name;
  }
  EXPECT_GT(std::distance(fs::directory_iterator(here), {}), 1) << "what a run wrote is not replaced by the next";
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Captured, published, dropped and failed frames of the summary at the end of a run.
std::array<long long, 4> counts(const std::string& output) {
  std::array<long long, 4> n{};
  const std::regex summary("([0-9]+) frames in .*: ([0-9]+) published, ([0-9]+) dropped, ([0-9]+) failed");
  std::smatch found;
  if (std::regex_search(output, found, summary))
    for (std::size_t i = 0; i < n.size(); ++i) n[i] = std::stoll(found[i + 1]);
  return n;
}

constexpr long kMemory = 512 << 20;

TEST_F(Service, TracksWithinALimitOfItsMemory) {
  const auto limit = MemoryLimit::make(kMemory);
  if (!limit) GTEST_SKIP() << "no control groups here";
  ChildProcess child(
      limit->command({BAREHAND_PROGRAM, "track", "--source", "sim:grasp_ball,live=true,loop=true,noise=kinect",
                      "--no-publish", "--result", folder_ / "result.csv", "--states-log", folder_ / "states.lcmlog"}));
  EXPECT_FALSE(socket_.wait_for("WATCHDOG").empty());
  for (int second = 0; second < 5; ++second) EXPECT_FALSE(socket_.wait_for("STATUS").empty());
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
  const auto [captured, published, dropped, failed] = counts(child.output());
  EXPECT_GT(published, 0) << child.output();
  EXPECT_EQ(captured, published + dropped + failed) << child.output();
  EXPECT_EQ(failed, 0) << child.output();
  EXPECT_LT(child.peak_memory(), kMemory);
  EXPECT_GT(limit->peak(), 10 << 20) << "it did not run within the limit";
}

TEST_F(Service, TheLimitOfMemoryIsOne) {
  const auto limit = MemoryLimit::make(16 << 20);
  if (!limit) GTEST_SKIP() << "no control groups here";
  EXPECT_EQ(ChildProcess(limit->command(command())).finish(), 128 + SIGKILL);
}
#endif

/// How often `text` contains `part`.
int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_F(Service, WritesResultsAgainWhenTheFullDiskHasRoom) {
  if (!SmallDisk::possible()) GTEST_SKIP() << "no mount namespaces here";
  const test::TempFolder hidden, outside;  // the small disk is mounted on the first folder
  const SmallDisk disk(hidden.path());
  const std::string table = hidden / "result.csv", log = hidden / "states.lcmlog";
  ChildProcess child(disk.command(command({"--result", table, "--states-log", log})));
  ASSERT_TRUE(child.wait_for("failed in states log")) << child.output();
  disk.beside(child, "head -c 200000 /dev/zero > " + (hidden / "more") + " || true");  // fills the disk completely
  ASSERT_TRUE(child.wait_for("failed in result table")) << child.output();
  disk.beside(child, "rm " + (hidden / "more"));
  disk.make_room(child);
  ASSERT_TRUE(child.wait_for("states log works again")) << child.output();
  ASSERT_TRUE(child.wait_for("result table works again")) << child.output();
  const std::string told = child.output();
  for (int second = 0; second < 2; ++second) EXPECT_FALSE(socket_.wait_for("STATUS").empty());
  disk.beside(child, "cp " + table + ".unfinished " + (outside / "result.csv") + " && cp " + log + ".unfinished " +
                         (outside / "states.lcmlog"));
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
  EXPECT_LE(count(told, "failed in result table"), 8) << told;

  const auto results = read_table(outside / "result.csv");
  ASSERT_TRUE(results) << results.error().message();
  const auto numbers = results->frames;
  ASSERT_GT(numbers.size(), 2u);
  const auto gap = std::adjacent_find(numbers.begin(), numbers.end(),
                                      [](const TableFrame& a, const TableFrame& b) { return b.number > a.number + 1; });
  EXPECT_NE(gap, numbers.end()) << "frames of the time without room are missing";
  const auto states = LcmLogReader::open(outside / "states.lcmlog");
  ASSERT_TRUE(states) << states.error().message();
  EXPECT_EQ(states->damaged_bytes(), 0);
}

TEST(Unit, IsWhatSystemdUnderstands) {
  if (ChildProcess({"bash", "-c", "command -v systemd-analyze"}).finish() != 0)
    GTEST_SKIP() << "no systemd-analyze here";
  const test::TempFolder folder;
  for (const auto& unit : fs::directory_iterator(BAREHAND_DEPLOY "/systemd")) {
    const std::string installed = test::read_text(unit.path());
    const std::string path = folder / unit.path().filename().string();
    test::write_text(path, std::regex_replace(installed, std::regex("/usr/bin/barehand"), BAREHAND_PROGRAM));
    ChildProcess verify({"systemd-analyze", "verify", "--recursive-errors=no", "--man=no", path});
    EXPECT_EQ(verify.finish(), 0) << verify.output();
    EXPECT_EQ(verify.output(), "") << "an unknown setting is only a warning to systemd";
  }
}

}  // namespace
}  // namespace barehand
