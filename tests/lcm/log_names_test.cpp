#include "io/lcm/log_names.h"

#include <gmock/gmock.h>

#include "io/lcm/lcm_log_writer.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST(LogNames, OfLcmLoggerAndOthersAreLogs) {
  for (const char* name : {"take.lcmlog", "take.lcm", "take.log", "take.lcmlog.00", "take.lcmlog.100", "take.lcmlog.0",
                           "lcmlog-2026-11-26", "lcmlog-2026-11-26.00", "/data/lcmlog-2026-11-26.07", "a b.lcmlog"})
    EXPECT_TRUE(is_log_name(name)) << name;
  for (const char* name : {"take", "take.00", "take.01.d", "lcmlog-of-monday", "take.lcmlog.zip", "lcmlog.d/take",
                           "take.lcmlog.unfinished", ".take.lcmlog.lock", "take.0000000000"})
    EXPECT_FALSE(is_log_name(name)) << name;
}

TEST(LogNames, ASetHasNumbers) {
  EXPECT_EQ(number_in_set("/data/take-000007-20261122T090000Z.lcmlog", "take.lcmlog"), 7);
  EXPECT_EQ(number_in_set("take-1-000007-20261122T090000Z.lcmlog", "take-1.lcmlog"), 7);
  EXPECT_FALSE(number_in_set("other-000007-20261122T090000Z.lcmlog", "take.lcmlog"));
  EXPECT_FALSE(number_in_set("take-000007-20261122T090000Z.lcmlog", "take.log"));
  EXPECT_FALSE(number_in_set("take-000007.lcmlog", "take.lcmlog"));
}

class FindLogs : public ::testing::Test {
 protected:
  void make(const std::string& name) const { test::write_text(folder_ / name, "\xed\xa1\xda\x01 the rest"); }
  /// The names of the logs that are found.
  std::vector<std::string> find(const std::string& path) const {
    const auto found = find_logs(path);
    if (!found) return {found.error().message()};
    std::vector<std::string> names;
    for (const std::string& file : found->files) names.push_back(fs::path(file).filename());
    for (const Error& error : found->left_out) names.push_back("not " + fs::path(error.where).filename().string());
    return names;
  }
  const test::TempFolder folder_;
};

TEST_F(FindLogs, PartsGoByTheirNumbers) {
  for (const char* name : {"b.lcmlog", "a.lcmlog.100", "a.lcmlog.02", "a.lcmlog.10", "a.lcmlog.01", "c.log.00"})
    make(name);
  EXPECT_THAT(find(folder_.path()),
              ElementsAre("a.lcmlog.01", "a.lcmlog.02", "a.lcmlog.10", "a.lcmlog.100", "b.lcmlog", "c.log.00"));
}

TEST_F(FindLogs, WhereLcmLoggerRotatesZeroIsTheNewest) {
  for (int i = 0; i <= 10; ++i) make("a.lcmlog." + std::to_string(i));
  EXPECT_THAT(find(folder_.path()),
              ElementsAre("a.lcmlog.10", "a.lcmlog.9", "a.lcmlog.8", "a.lcmlog.7", "a.lcmlog.6", "a.lcmlog.5",
                          "a.lcmlog.4", "a.lcmlog.3", "a.lcmlog.2", "a.lcmlog.1", "a.lcmlog.0"));
}

TEST_F(FindLogs, TheNameOfASetStandsForItsParts) {
  for (const char* name : {"take.lcmlog.00", "take.lcmlog.01", "other.lcmlog.00", "day.00", "day.01",
                           "set-000002-20261122T090000Z.lcmlog", "set-000001-20261122T080000Z.lcmlog"})
    make(name);
  EXPECT_THAT(find(folder_ / "take.lcmlog"), ElementsAre("take.lcmlog.00", "take.lcmlog.01"));
  EXPECT_THAT(find(folder_ / "day"), ElementsAre("day.00", "day.01"));
  EXPECT_THAT(find(folder_ / "set.lcmlog"),
              ElementsAre("set-000001-20261122T080000Z.lcmlog", "set-000002-20261122T090000Z.lcmlog"));
  EXPECT_THAT(find(folder_ / "take.lcmlog.01"), ElementsAre("take.lcmlog.01"));
  make("take.lcmlog");
  EXPECT_THAT(find(folder_ / "take.lcmlog"), ElementsAre("take.lcmlog")) << "a file is itself";
  EXPECT_THAT(find(folder_ / "none.lcmlog"), ElementsAre("none.lcmlog")) << "opening it says what is wrong";
}

TEST_F(FindLogs, WhatAKilledRecorderLeftIsInThePlaceOfItsName) {
  for (const char* name :
       {"set-000001-20260922T090000Z.lcmlog", "set-000002-20260922T091000Z.lcmlog.unfinished",
        "set-000003-20260922T092000Z.lcmlog", "take.lcmlog.unfinished", "take.lcmlog.unfinished-2", "zoo.lcmlog"})
    make(name);
  EXPECT_THAT(find(folder_.path()),
              ElementsAre("set-000001-20260922T090000Z.lcmlog", "set-000002-20260922T091000Z.lcmlog.unfinished",
                          "set-000003-20260922T092000Z.lcmlog", "take.lcmlog.unfinished", "take.lcmlog.unfinished-2",
                          "zoo.lcmlog"));
  EXPECT_THAT(find(folder_ / "set.lcmlog"),
              ElementsAre("set-000001-20260922T090000Z.lcmlog", "set-000002-20260922T091000Z.lcmlog.unfinished",
                          "set-000003-20260922T092000Z.lcmlog"));
  EXPECT_THAT(find(folder_ / "take.lcmlog"), ElementsAre("take.lcmlog.unfinished", "take.lcmlog.unfinished-2"));
  EXPECT_THAT(find(folder_ / "take.lcmlog.unfinished-2"), ElementsAre("take.lcmlog.unfinished-2"));
}

TEST_F(FindLogs, ADraftWhoseNameIsTakenIsNamed) {
  for (const char* name : {"take.lcmlog", "take.lcmlog.unfinished"}) make(name);
  EXPECT_THAT(find(folder_.path()), ElementsAre("take.lcmlog", "not take.lcmlog.unfinished"));
}

TEST_F(FindLogs, WhatALivingRecorderWritesIsNamed) {
  auto writer = LcmLogWriter::create(folder_ / "set-000002-20260922T091000Z.lcmlog", false).value();
  const std::vector<std::uint8_t> message(10);
  ASSERT_TRUE(writer->send("A", message, 1));
  EXPECT_THAT(find(folder_.path()), ElementsAre("not set-000002-20260922T091000Z.lcmlog.unfinished"));
  make("set-000001-20260922T090000Z.lcmlog");
  EXPECT_THAT(find(folder_ / "set.lcmlog"),
              ElementsAre("set-000001-20260922T090000Z.lcmlog", "not set-000002-20260922T091000Z.lcmlog.unfinished"));
  ASSERT_TRUE(writer->finish());
  EXPECT_THAT(find(folder_.path()),
              ElementsAre("set-000001-20260922T090000Z.lcmlog", "set-000002-20260922T091000Z.lcmlog"));
}

TEST_F(FindLogs, WhatIsNoLogInAFolderIsLeftAlone) {
  for (const char* name : {"take.lcmlog", "day.00"}) make(name);
  for (const char* name : {"depth.txt", "note.00", ".take.lcmlog.lock", "take.lcmlog.unfinished"})
    test::write_text(folder_ / name, "text");
  test::write_text(folder_ / "empty.lcmlog", "");
  fs::create_directory(folder_ / "folder.lcmlog");
  fs::create_symlink("nowhere", folder_ / "gone.lcmlog");
  EXPECT_THAT(find(folder_.path()), ElementsAre("day.00", "take.lcmlog"));
  EXPECT_THAT(find(folder_ / "folder.lcmlog"), ElementsAre(HasSubstr("holds no LCM logs")));
}

}  // namespace
}  // namespace barehand
