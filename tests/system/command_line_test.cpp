#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "support/barehand_program.h"
#include "support/quick_config.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string shipped_config() { return test::read_text(BAREHAND_CONFIGS "/default.yaml"); }

TEST(CommandLine, HelpAndVersionSucceed) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{{"--help"},
                                                                                         {"--version"},
                                                                                         {"track", "--help"},
                                                                                         {"bench", "--help"},
                                                                                         {"eval", "--help"},
                                                                                         {"experiment", "--help"},
                                                                                         {"doctor", "--help"}}) {
    const Outcome outcome = barehand(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments[0];
    EXPECT_FALSE(outcome.output.empty());
  }
}

TEST(CommandLine, TheManPageHasEveryCommand) {
  std::string page = test::read_text(BAREHAND_CONFIGS "/../deploy/debian/barehand.1");
  std::erase(page, '\\');  // troff writes the hyphen of a command as \-
  std::istringstream help(barehand({"--help"}).output);
  std::string line;
  while (std::getline(help, line) && line != "Subcommands:") continue;
  int commands = 0;
  for (std::string name; std::getline(help, line) && std::istringstream(line) >> name; ++commands)
    EXPECT_THAT(page, HasSubstr("\n.B " + name + "\n"));
  EXPECT_GT(commands, 5);
}

TEST(CommandLine, WrongUsageIsExitCode2) {
  EXPECT_EQ(barehand({}).exit_code, 2);
  EXPECT_EQ(barehand({"juggle"}).exit_code, 2);
  EXPECT_EQ(barehand({"track", "--sauce", "lcm"}).exit_code, 2);
  EXPECT_EQ(barehand({"experiment", "juggling", "--out", "/nonexistent"}).exit_code, 2);
  EXPECT_EQ(barehand({"experiment", "fist"}).exit_code, 2);
  EXPECT_EQ(barehand({"track", "--source", "lcm", "--threads", "two"}).exit_code, 2);
  EXPECT_EQ(barehand({"track", "--source", "lcm", "--start", "3"}).exit_code, 2) << "systemd would start it for ever";
  EXPECT_EQ(barehand({"track", "--source", "lcm", "--lcm-url", "foo"}).exit_code, 2);
  EXPECT_EQ(barehand({"track", "--source", "sim:fist,live=true", "--lcm-url", "foo"}).exit_code, 2);
  EXPECT_EQ(barehand({"view", "--lcm", "--lcm-url", "foo"}).exit_code, 2);
  EXPECT_EQ(barehand({"bench", "--source", "lcm"}).exit_code, 2);
}

TEST(CommandLine, EmptyNamesAreNotTakenForNone) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"convert", "/nonexistent", ""},
                                                    {"record", "--source", "sim:fist", "--out", ""},
                                                    {"track", "--source", "sim:fist", "--no-publish", "--result", ""},
                                                    {"view", ""},
                                                    {"calibrate", "--out", ""}}) {
    const Outcome outcome = barehand(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments[0];
    EXPECT_THAT(outcome.output, HasSubstr("is empty")) << arguments[0];
  }
}

TEST(CommandLine, LimitsOfRecordingsArePositive) {
  for (const std::string option : {"--quota=-1", "--quota=0", "--max-size=-1", "--max-age=-5s", "--max-age=0s"})
    EXPECT_EQ(barehand({"record", "--source", "sim:fist", "--out", "/nonexistent/a.lcmlog", option}).exit_code, 2)
        << option;
}

TEST(Bench, MeasuresAndWritesFigures) {
  const test::TempFolder folder;
  const std::string json = folder / "bench.json";
  const Outcome outcome = barehand({"bench", "--source", "sim:fist,width=160,height=120", "--store", "3", "--frames",
                                    "3", "--warm-up", "1", "--hand", "both", "--json", json});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("frames/s"), HasSubstr("capture to publish")));
  EXPECT_THAT(test::read_text(json), HasSubstr("\"hands\": 2"));
  EXPECT_EQ(
      barehand({"bench", "--threads", "0", "--source", "sim:fist,width=160,height=120", "--store", "1"}).exit_code, 2);
}

TEST(Track, NeedsASource) {
  const Outcome outcome = barehand({"track"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("folder:DIR, log:FILE, lcm, openni2 or sim:NAME"));
}

TEST(Track, RefusesUnknownSources) {
  for (const char* spec : {"camera", "folder", "folder:", "flodder:/tmp", "lcm:", ""}) {
    const Outcome outcome = barehand({"track", "--no-publish", "--source", spec});
    EXPECT_EQ(outcome.exit_code, 2) << spec;
    EXPECT_THAT(outcome.output, HasSubstr("folder:DIR")) << spec;
  }
}

TEST(Track, SaysWhichInputFileIsMissing) {
  for (const char* spec : {"folder:/nonexistent/hand", "log:/nonexistent/hand.lcmlog"}) {
    const Outcome outcome = barehand({"track", "--no-publish", "--source", spec});
    EXPECT_EQ(outcome.exit_code, 2) << spec;
    EXPECT_THAT(outcome.output, HasSubstr("/nonexistent/hand")) << spec;
  }
  const Outcome outcome = barehand({"track", "--source", "lcm", "--config", "/nonexistent.yaml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("/nonexistent.yaml"));
}

TEST(Track, RefusesAbsurdThreadCountsAndSteps) {
  for (const char* threads : {"0", "-2", "100000"}) {
    const Outcome outcome = barehand({"track", "--source", "lcm", "--lcm-url", "memq://", "--threads", threads});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, HasSubstr(std::string("number of threads is ") + threads));
  }
  EXPECT_THAT(barehand({"track", "--source", "folder:/tmp", "--step", "0"}).output, HasSubstr("step of 0"));
  EXPECT_THAT(barehand({"track", "--source", "lcm", "--start", "3"}).output, HasSubstr("for recordings"));
}

TEST(Track, RefusesMoreSamplesThanMemoryHolds) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers do not start under ulimit -v";
#endif
  const std::string text = std::regex_replace(shipped_config(), std::regex(" samples: [0-9]+"), " samples: 9000");
  const test::TempFolder folder;
  const std::string path = folder / "many_samples.yaml";
  test::write_text(path, text);
  ChildProcess child(
      {"bash", "-c", "ulimit -v 2000000; exec " BAREHAND_PROGRAM " track --source lcm --config " + path});
  EXPECT_EQ(child.finish(), 2);
  EXPECT_THAT(child.output(), HasSubstr("tracker.segment_tracker.samples: 9000 samples take "));
  EXPECT_THAT(child.output(), HasSubstr("give at most "));
}

TEST(Track, StopsAtAMisspelledKeyWithFileLineAndSuggestion) {
  std::string text = shipped_config();
  const auto at = text.find("\n  min_depth:");
  ASSERT_NE(at, std::string::npos);
  const auto line = 2 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  text.replace(at, 13, "\n  min_dpeth:");
  const test::TempFolder folder;
  const std::string path = folder / "misspelled.yaml";
  test::write_text(path, text);
  const Outcome outcome = barehand({"track", "--source", "lcm", "--config", path});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr(path + ":" + std::to_string(line) +
                                        ": unknown key 'preprocess.min_dpeth', did "
                                        "you mean 'preprocess.min_depth'?"));
}

TEST(Track, StopsAtAChannelPrefixThatLcmDoesNotTake) {
  const test::TempFolder folder;
  const std::string path = folder / "long_prefix.yaml";
  test::write_text(path, test::replaced(shipped_config(), "channel_prefix: \"\"",
                                        "channel_prefix: \"" + std::string(60, 'X') + "\""));
  const Outcome outcome = barehand({"track", "--source", "lcm", "--lcm-url", "memq://", "--config", path});
  EXPECT_EQ(outcome.exit_code, 2) << "systemd would start it again for ever";
  EXPECT_THAT(outcome.output, HasSubstr("the channel prefix is too long"));
}

TEST(Track, StopsAtARoomThatIsNone) {
  const test::TempFolder folder;
  const std::string path = folder / "room.yaml";
  test::write_text(path, "world: {T_world_camera: [0, 0, 1, 0, 0, 0, 0.9]}\n");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"track", "--source", "sim:fist"},
        {"view", "--lcm"},
        {"calibrate", "--source", "sim:scan", "--out", folder / "mine.json"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--config", path});
    const Outcome outcome = barehand(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(path + ": world.T_world_camera: the quaternion has the norm 0.9"));
  }
}

TEST(Track, RecordsFromThePageOnlyIntoAFolder) {
  const test::TempFolder folder;
  test::write_text(folder / "file", "");
  const std::vector<std::string> track = {"track", "--source", "sim:fist", "--no-publish", "--view-record"};
  const std::vector<std::string> view = {"view", "--record"};
  for (const auto& [command, rest, reason] :
       {std::tuple(track, std::vector<std::string>{folder.path()}, "give --view, too"),
        {track, {folder / "nowhere", "--view"}, "make the folder first"},
        {track, {folder / "file", "--view"}, "is no folder"},
        {view, {folder / "nowhere", "--lcm"}, "make the folder first"},
        {view, {folder.path(), "a.lcmlog"}, "give --lcm instead of a log"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), rest.begin(), rest.end());
    const Outcome outcome = barehand(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(reason));
  }
}

TEST(Track, StopsAtADepthRangeThatIsEmpty) {
  const test::TempFolder folder;
  const std::string path = folder / "range.yaml";
  test::write_text(path, "preprocess: {min_depth: 0.5, max_depth: 0.4}\n");
  const Outcome outcome = barehand({"track", "--source", "sim:fist", "--config", path});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(path + ": preprocess: nothing lies between min_depth and max_depth"));
}

TEST(Track, StopsAtAMissingFolderOfAnOutput) {
  const test::TempFolder folder;
  const std::string nowhere = folder / "nowhere";
  for (const auto& [option, file] : {std::pair("--result", "a.csv"), {"--save-hand", "a.json"}, {"--mcap", "a.mcap"}}) {
    const Outcome outcome =
        barehand({"track", "--source", "sim:fist,frames=1", "--no-publish", option, nowhere + "/" + file});
    EXPECT_EQ(outcome.exit_code, 2) << "systemd would start it again for ever: " << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("there is no folder " + nowhere + " (make the folder first)"));
  }
}

TEST(Track, PrintsTheConfigInForceAndTakesItBack) {
  const Outcome printed = barehand({"track", "--print-config", "--seed", "42"});
  EXPECT_EQ(printed.exit_code, 0);
  EXPECT_THAT(printed.output, HasSubstr("\n  seed: 42\n"));
  EXPECT_THAT(printed.output, Not(HasSubstr("search_attempts"))) << "is for experts";
  const test::TempFolder folder;
  const std::string path = folder / "printed.yaml";
  test::write_text(path, printed.output);
  EXPECT_EQ(barehand({"track", "--print-config", "--config", path}).output, printed.output);
}

TEST(Track, PrintsEveryKeyOrWhatWasChangedOnRequest) {
  EXPECT_THAT(barehand({"track", "--print-config=all"}).output, HasSubstr("\n  search_attempts: 16\n"));
  EXPECT_EQ(barehand({"track", "--print-config=changed"}).output, "");
  EXPECT_THAT(barehand({"track", "--print-config=changed", "--config", "paper"}).output,
              HasSubstr("\n    levels: 10\n"));
  EXPECT_EQ(barehand({"track", "--print-config=some"}).exit_code, 2);
}

TEST(Track, FindsShippedConfigsByName) {
  for (const char* name : {"paper", "paper.yaml", "accurate.yaml"})
    EXPECT_EQ(barehand({"track", "--print-config", "--config", name}).exit_code, 0) << name;
}

/// Whether a private network without any route can be created, which is not allowed everywhere.
bool can_unshare() { return ChildProcess({"unshare", "-rn", "true"}).finish() == 0; }

TEST(Track, SaysHowToMendAMissingMulticastRoute) {
  if (!can_unshare()) GTEST_SKIP() << "no network namespaces here";
  ChildProcess child({"unshare", "-rn", BAREHAND_PROGRAM, "track", "--source", "sim:fist,width=160,height=120",
                      "--lcm-url", "udpm://239.255.76.67:7667?ttl=0"});
  EXPECT_EQ(child.finish(), 1);
  EXPECT_THAT(child.output(), HasSubstr("ip route add 224.0.0.0/4 dev lo"));
}

TEST(Track, WaitsForTheNetworkAsItWaitsForFrames) {
  if (!can_unshare()) GTEST_SKIP() << "no network namespaces here";
  ChildProcess child(
      {"unshare", "-rn", BAREHAND_PROGRAM, "track", "--source", "lcm", "--lcm-url", "udpm://239.255.76.67:7667?ttl=0"});
  ASSERT_TRUE(child.wait_for("ip route add 224.0.0.0/4 dev lo")) << child.output();
  EXPECT_EQ(ChildProcess({"nsenter", "--preserve-credentials", "-U", "-n", "-t", std::to_string(child.pid()), "sh",
                          "-c", "ip link set lo up && ip route add 224.0.0.0/4 dev lo"})
                .finish(),
            0);
  ASSERT_TRUE(child.wait_for("info: tracking lcm:udpm")) << child.output();
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
}

TEST(Track, OutlivesANetworkThatIsGoneForAWhile) {
  if (!can_unshare()) GTEST_SKIP() << "no network namespaces here";
  const test::TempFolder folder;
  const std::string config = folder / "quick.yaml";
  test::write_text(config, test::quick_config());
  ChildProcess child({"unshare", "-rn", "sh", "-c",
                      "ip link set lo up && ip route add 224.0.0.0/4 dev lo && exec " BAREHAND_PROGRAM
                      " track --source sim:fist,live=true,loop=true,width=160,height=120 --health"
                      " --lcm-url 'udpm://239.255.76.67:7667?ttl=0' --config " +
                          config});
  const auto ip = [&](const std::string& change) {
    return ChildProcess({"nsenter", "--preserve-credentials", "-U", "-n", "-t", std::to_string(child.pid()), "sh", "-c",
                         "ip route " + change + " 224.0.0.0/4 dev lo"})
        .finish();
  };
  ASSERT_TRUE(child.wait_for("captured ")) << child.output();
  EXPECT_EQ(ip("del"), 0);
  ASSERT_TRUE(child.wait_for("LCM cannot publish")) << child.output();
  const auto failed = [&] {
    const std::string& said = child.output();
    const auto at = said.rfind("failed ");
    return at == std::string::npos ? 0 : std::atoi(said.c_str() + at + 7);
  };
  while (failed() <= 60)
    ASSERT_TRUE(child.wait_for_more()) << child.output();  // twice the number of failures that would end a replay
  EXPECT_EQ(ip("add"), 0);
  const auto published = [&] {
    const std::string& said = child.output();
    const auto at = said.rfind("published ");
    return at == std::string::npos ? 0 : std::atoi(said.c_str() + at + 10);
  };
  const int before = published();
  while (published() <= before + 10) ASSERT_TRUE(child.wait_for_more()) << child.output();
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
}

TEST(Track, CanBeStoppedWhileItWaitsForTheNetwork) {
  if (!can_unshare()) GTEST_SKIP() << "no network namespaces here";
  for (const auto& [signal, exit_code] : {std::pair(SIGTERM, 0), std::pair(SIGINT, 130)}) {
    ChildProcess child({"unshare", "-rn", BAREHAND_PROGRAM, "track", "--source", "lcm", "--lcm-url",
                        "udpm://239.255.76.67:7667?ttl=0"});
    ASSERT_TRUE(child.wait_for("trying again")) << child.output();
    child.signal(signal);
    EXPECT_EQ(child.finish(), exit_code) << child.output();
  }
}
// The doctor loads graphics drivers, which leak memory. The leak sanitizer would change the exit status.
#define BAREHAND_DOCTOR "ASAN_OPTIONS=detect_leaks=0 " BAREHAND_PROGRAM " doctor"

TEST(Doctor, FindsTheMissingMulticastRoute) {
  if (!can_unshare()) GTEST_SKIP() << "no network namespaces here";
  ChildProcess child({"unshare", "-rn", "sh", "-c", BAREHAND_DOCTOR});
  EXPECT_EQ(child.finish(), 1);
  EXPECT_THAT(child.output(),
              AllOf(HasSubstr("PROBLEM multicast route"), HasSubstr("ip route add 224.0.0.0/4 dev lo")));
}

TEST(Doctor, IsSatisfiedWithARoute) {
  if (!can_unshare()) GTEST_SKIP() << "no network namespaces here";
  ChildProcess child(
      {"unshare", "-rn", "sh", "-c", "ip link set lo up && ip route add 224.0.0.0/4 dev lo && " BAREHAND_DOCTOR});
  child.finish();  // the exit code depends on what else the machine lacks
  EXPECT_THAT(child.output(), AllOf(HasSubstr("ok      multicast route: through lo"), HasSubstr("ok      LCM: ")));
}

}  // namespace
}  // namespace barehand
