#include "io/lcm/rotating_log.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "io/lcm/lcm_log_reader.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Rotating : public ::testing::Test {
 protected:
  std::unique_ptr<RotatingLog> open(const LogRotation& rotation) {
    return RotatingLog::create(folder_ / "set/take.lcmlog", rotation, clock_).value();
  }
  /// Writes an event that takes 1000 bytes in the file.
  void send(RotatingLog& log, std::int64_t utime) {
    const std::vector<std::uint8_t> message(1000 - 28 - 1, 7);
    const auto sent = log.send("A", message, utime);
    EXPECT_TRUE(sent) << sent.error().message();
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "set")) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }
  /// Time stamps of the events in all files, in their order [us].
  std::vector<std::int64_t> stamps() const {
    std::vector<std::int64_t> stamps;
    for (const std::string& name : names()) {
      const auto log = LcmLogReader::open(folder_ / ("set/" + name));
      EXPECT_TRUE(log) << log.error().message();
      EXPECT_EQ(log->damaged_bytes(), 0);
      for (const LogEntry& entry : log->entries()) stamps.push_back(entry.timestamp);
    }
    return stamps;
  }
  const test::TempFolder folder_;
  ManualClock clock_{1'790'000'000'000'000};  // 2026-09-21 14:13:20 UTC
};

TEST_F(Rotating, GoesOnInANewFileAtTheLargestSize) {
  const auto log = open({.max_bytes = 2500});
  for (int i = 1; i <= 5; ++i) send(*log, i);
  EXPECT_EQ(names().back(), "take-000003-20260921T141320Z.lcmlog.unfinished") << "the one that is written";
  ASSERT_TRUE(log->finish());
  EXPECT_THAT(names(), ElementsAre("take-000001-20260921T141320Z.lcmlog", "take-000002-20260921T141320Z.lcmlog",
                                   "take-000003-20260921T141320Z.lcmlog"));
  EXPECT_THAT(stamps(), ElementsAre(1, 2, 3, 4, 5));
}

TEST_F(Rotating, GoesOnInANewFileAtTheLargestAge) {
  const auto log = open({.max_age_us = 10'000'000});
  for (int i = 1; i <= 4; ++i) {
    send(*log, i);
    clock_.advance(6'000'000);
  }
  EXPECT_EQ(names().size(), 2u);
  EXPECT_THAT(stamps(), ElementsAre(1, 2, 3, 4));
}

TEST_F(Rotating, TheOldestFilesMakeRoomWithinTheQuota) {
  const auto log = open({.max_bytes = 2000, .quota = 5000});
  for (int i = 1; i <= 20; ++i) {
    send(*log, i);
    std::uintmax_t used = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "set")) used += entry.file_size();
    EXPECT_LE(used, 5000u);
  }
  EXPECT_THAT(stamps(), ElementsAre(17, 18, 19, 20));
  EXPECT_EQ(log->removed_events(), 16);
}

TEST_F(Rotating, AnotherRunGoesOnWithTheSetAndItsQuota) {
  for (int run = 0; run < 3; ++run) {
    const auto log = open({.max_bytes = 2000, .quota = 5000});
    for (int i = 0; i < 2; ++i) send(*log, 10 * run + i);
    EXPECT_EQ(log->removed_events(), 0) << "the removed ones are of an earlier run";
  }
  EXPECT_THAT(names(), ElementsAre(HasSubstr("take-000002-"), HasSubstr("take-000003-")));
  EXPECT_THAT(stamps(), ElementsAre(10, 11, 20, 21));
}

TEST_F(Rotating, WhatAKilledRunLeftIsPartOfTheSet) {
  const std::string first = folder_ / "set/take-000001-20260921T141320Z.lcmlog";
  {
    const auto log = open({.max_bytes = 2000});
    for (int i = 1; i <= 2; ++i) send(*log, i);
  }
  fs::rename(first, first + ".unfinished");
  std::ofstream(folder_ / "set/other-000007-20260921T141320Z.lcmlog.unfinished") << "of another set";
  {
    const auto log = open({.max_bytes = 2000});
    send(*log, 3);
  }
  EXPECT_THAT(names(), ElementsAre("other-000007-20260921T141320Z.lcmlog.unfinished",
                                   "take-000001-20260921T141320Z.lcmlog", "take-000002-20260921T141320Z.lcmlog"));
}

TEST_F(Rotating, OtherFilesAreNotItsOwn) {
  fs::create_directory(folder_ / "set");
  const std::vector<std::string> others = {"other-000001-20260921T141320Z.lcmlog", "take-000001-20260921T141320Z.txt",
                                           "take-1.lcmlog", "take.lcmlog"};
  for (const std::string& name : others) std::ofstream(folder_ / ("set/" + name)) << std::string(9000, 'x');
  const auto log = open({.max_bytes = 2000, .quota = 4000});
  for (int i = 0; i < 20; ++i) send(*log, i);
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(folder_ / ("set/" + name))) << name;
}

TEST_F(Rotating, AFileThatSomebodyRemovedIsNoTrouble) {
  const auto log = open({.max_bytes = 2000, .quota = 5000});
  for (int i = 1; i <= 4; ++i) send(*log, i);
  fs::remove(folder_ / ("set/" + names().front()));
  for (int i = 5; i <= 10; ++i) send(*log, i);
  EXPECT_EQ(stamps().back(), 10);
}

/// Replaces a file that this process has open by a full device, which can neither be written nor truncated.
void break_open_file(const fs::path& path) {
  bool broken = false;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    std::error_code gone;  // the descriptor that reads this folder has no target any more
    if (fs::read_symlink(entry.path(), gone) != path) continue;
    const int full = ::open("/dev/full", O_WRONLY);
    ::dup2(full, std::stoi(entry.path().filename()));
    ::close(full);
    broken = true;
  }
  EXPECT_TRUE(broken) << path << " is not open";
}

TEST_F(Rotating, GoesOnInANewFileWhereAFailedWriteCannotBeUndone) {
  const auto log = open({.max_bytes = 3000, .quota = 9000});
  for (int i = 1; i <= 4; ++i) send(*log, i);
  break_open_file(fs::canonical(folder_ / ("set/" + names().back())));
  EXPECT_FALSE(log->send("A", std::vector<std::uint8_t>(1000 - 28 - 1, 7), 5));
  send(*log, 6);
  EXPECT_THAT(stamps(), ElementsAre(1, 2, 3, 4, 6));
  EXPECT_EQ(names().size(), 3u);
}

TEST_F(Rotating, AQuotaOfLessThanTwoFilesIsRefused) {
  EXPECT_FALSE(RotatingLog::create(folder_ / "take.lcmlog", {.max_bytes = 3000, .quota = 5000}, clock_));
}

}  // namespace
}  // namespace barehand
