#include "io/lcm/lcm_log_writer.h"

#include <gtest/gtest.h>

#include <fstream>
#include <lcm/lcm-cpp.hpp>

#include "io/lcm/lcm_log_reader.h"
#include "support/resource_limit.h"
#include "support/temp_folder.h"
#include "test_frames.h"

namespace barehand {
namespace {

const std::vector<std::uint8_t> kMessage = {1, 2, 3, 4, 5};

TEST(LcmLogWriter, WritesWhatLcmReads) {
  const test::TempFolder folder;
  {
    auto log = LcmLogWriter::create(folder / "a.lcmlog", false).value();
    ASSERT_TRUE(log->send("HAND_STATE", kMessage, 123456));
    ASSERT_TRUE(log->send("HEALTH", {}, 123457));
    EXPECT_EQ(log->events(), 2);
  }
  lcm::LogFile log(folder / "a.lcmlog", "r");
  const lcm::LogEvent* event = log.readNextEvent();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->channel, "HAND_STATE");
  EXPECT_EQ(event->timestamp, 123456);
  EXPECT_EQ(event->eventnum, 0);
  const auto* data = static_cast<const std::uint8_t*>(event->data);
  EXPECT_EQ(std::vector<std::uint8_t>(data, data + event->datalen), kMessage);
  event = log.readNextEvent();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->eventnum, 1);
  EXPECT_EQ(event->datalen, 0);
  EXPECT_EQ(log.readNextEvent(), nullptr);
}

TEST(LcmLogWriter, EveryEventIsInTheFileAtOnce) {
  const test::TempFolder folder;
  auto log = LcmLogWriter::create(folder / "a.lcmlog", false).value();
  for (int i = 1; i <= 3; ++i) {
    ASSERT_TRUE(log->send("A", kMessage, i));
    EXPECT_EQ(LcmLogReader::open(folder / "a.lcmlog.unfinished")->entries().size(), static_cast<std::size_t>(i));
    EXPECT_EQ(std::filesystem::file_size(folder / "a.lcmlog.unfinished"), static_cast<std::uintmax_t>(log->bytes()));
  }
}

TEST(LcmLogWriter, HasItsNameWhenItIsFinished) {
  const test::TempFolder folder;
  auto log = LcmLogWriter::create(folder / "a.lcmlog", false).value();
  ASSERT_TRUE(log->send("A", kMessage, 1));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.lcmlog"));
  ASSERT_TRUE(log->finish());
  EXPECT_EQ(LcmLogReader::open(folder / "a.lcmlog")->entries().size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.lcmlog.unfinished"));
  EXPECT_FALSE(log->send("A", kMessage, 2)) << "after the end";
}

TEST(LcmLogWriter, OneWithoutEventsLeavesNothingUnlessFinished) {
  const test::TempFolder folder;
  EXPECT_TRUE(LcmLogWriter::create(folder / "a.lcmlog", false));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_TRUE(LcmLogWriter::create(folder / "a.lcmlog", false).value()->finish());
  EXPECT_TRUE(std::filesystem::exists(folder / "a.lcmlog"));
}

TEST(LcmLogWriter, ReplacesAFileOnlyIfAllowed) {
  const test::TempFolder folder;
  std::ofstream(folder / "a.lcmlog") << "precious";
  EXPECT_FALSE(LcmLogWriter::create(folder / "a.lcmlog", false));
  EXPECT_EQ(std::filesystem::file_size(folder / "a.lcmlog"), 8u);
  EXPECT_TRUE(LcmLogWriter::create(folder / "a.lcmlog", true).value()->finish());
  EXPECT_EQ(std::filesystem::file_size(folder / "a.lcmlog"), 0u);
}

TEST(LcmLogWriter, AFolderThatDoesNotExistIsAnError) {
  EXPECT_FALSE(LcmLogWriter::create("/nonexistent/folder/a.lcmlog", false));
}

TEST(LcmLogWriter, AChannelThatNoReaderTakesIsAnError) {
  const test::TempFolder folder;
  auto log = LcmLogWriter::create(folder / "a.lcmlog", false).value();
  EXPECT_FALSE(log->send("", kMessage, 1));
  EXPECT_FALSE(log->send(std::string(64, 'A'), kMessage, 2));
  EXPECT_TRUE(log->send(std::string(63, 'A'), kMessage, 3));
  ASSERT_TRUE(log->finish());
  const auto read = LcmLogReader::open(folder / "a.lcmlog");
  EXPECT_EQ(read->entries().size(), 1u);
  EXPECT_EQ(read->damaged_bytes(), 0);
}

TEST(LcmLogWriter, AFullDeviceIsAnError) {
  auto log = LcmLogWriter::create("/dev/full", true).value();
  const auto sent = log->send("A", kMessage, 1);
  ASSERT_FALSE(sent);
  EXPECT_NE(sent.error().message().find("No space left"), std::string::npos);
  EXPECT_FALSE(log->send("A", kMessage, 2)) << "it stays failed";
}

TEST(LcmLogWriter, WhenTheDiskFillsUpTheWholeEventsStay) {
  const test::TempFolder folder;
  const std::vector<std::uint8_t> large(10'000, 7);
  {
    const test::FileSizeLimit limit(25'000);
    auto log = LcmLogWriter::create(folder / "a.lcmlog", false).value();
    ASSERT_TRUE(log->send("A", large, 1));
    ASSERT_TRUE(log->send("A", large, 2));
    const auto third = log->send("A", large, 3);
    ASSERT_FALSE(third);
    EXPECT_NE(third.error().message().find("2 events"), std::string::npos) << third.error().message();
  }
  const auto log = LcmLogReader::open(folder / "a.lcmlog");
  EXPECT_EQ(log->entries().size(), 2u);
  EXPECT_EQ(log->damaged_bytes(), 0);
}

TEST(LcmLogWriter, GoesOnWhenThereIsRoomAgain) {
  const test::TempFolder folder;
  const std::vector<std::uint8_t> large(10'000, 7);
  auto log = LcmLogWriter::create(folder / "a.lcmlog", false).value();
  {
    const test::FileSizeLimit limit(25'000);
    ASSERT_TRUE(log->send("A", large, 1));
    ASSERT_TRUE(log->send("A", large, 2));
    for (int i = 0; i < 3; ++i) ASSERT_FALSE(log->send("A", large, 3));
  }
  ASSERT_TRUE(log->send("A", large, 4));
  ASSERT_TRUE(log->finish());
  const auto read = LcmLogReader::open(folder / "a.lcmlog");
  ASSERT_EQ(read->entries().size(), 3u);
  EXPECT_EQ(read->entries().back().timestamp, 4);
  EXPECT_EQ(read->damaged_bytes(), 0);
  EXPECT_EQ(log->events(), 3);
}

}  // namespace
}  // namespace barehand
