#include <gmock/gmock.h>

#include <filesystem>

#include "io/mcap/mcap_reader.h"
#include "io/mcap/mcap_writer.h"
#include "mcap_bytes.h"
#include "support/resource_limit.h"
#include "support/temp_folder.h"

namespace barehand::mcap {
namespace {

using test::Bytes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Random bytes, which compression does not make smaller, so that the sizes of chunks can be predicted.
Bytes noise(std::size_t size, std::uint32_t seed) {
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>((seed = seed * 1664525 + 1013904223) >> 24);
  return bytes;
}

class McapFile : public testing::Test {
 protected:
  static NewMessage message(int number, std::size_t size = 500'000) {
    return {"/depth", "sensor_msgs/msg/Image", "uint32 width\n", {{"depth_unit", "0.001"}}, noise(size, number)};
  }
  /// Writes `count` messages. Three of them fill a chunk.
  void write(int count) {
    auto writer = McapWriter::create(path_, true).value();
    for (int i = 0; i < count; ++i) add(*writer, i);
    ASSERT_TRUE(writer->finish());
  }
  static void add(McapWriter& writer, int number) {
    const NewMessage one = message(number);
    ASSERT_TRUE(writer.write({&one, 1}, 1000 + static_cast<std::uint64_t>(number), static_cast<std::uint32_t>(number)));
  }
  /// The sequence numbers of the messages that are read as they were written, in the order of the file.
  std::vector<int> read() {
    std::vector<Message> found;
    auto reader = McapReader::open(path_, [&](const Message& message, const Channel& channel, auto) {
      EXPECT_EQ(channel.topic, "/depth");
      EXPECT_EQ(channel.type, "sensor_msgs/msg/Image");
      EXPECT_EQ(channel.metadata.at("depth_unit"), "0.001");
      found.push_back(message);
    });
    if (!reader) {
      ADD_FAILURE() << reader.error().message();
      return {};
    }
    warnings_ = reader->warnings();
    std::vector<int> numbers;
    for (const Message& one : found) {
      const auto bytes = reader->read(one);
      EXPECT_EQ(one.log_time, 1000 + one.sequence);
      const bool same = bytes && std::ranges::equal(*bytes, message(static_cast<int>(one.sequence)).bytes);
      numbers.push_back(same ? static_cast<int>(one.sequence) : -1);
    }
    return numbers;
  }

  test::TempFolder folder_;
  std::string path_ = folder_ / "a.mcap";
  std::vector<std::string> warnings_;
};

TEST_F(McapFile, ReadsWhatWasWritten) {
  write(5);
  EXPECT_THAT(read(), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(McapFile, EqualMessagesGiveEqualBytes) {
  write(5);
  const Bytes first = test::read_bytes(path_);
  write(5);
  EXPECT_EQ(test::read_bytes(path_), first);
}

TEST_F(McapFile, WhatAKilledProgramLeavesIsReadUpToItsLastChunk) {
  auto writer = McapWriter::create(path_, false).value();
  for (int i = 0; i < 8; ++i) add(*writer, i);
  std::filesystem::copy_file(path_ + ".unfinished", folder_ / "killed.mcap");
  ASSERT_TRUE(writer->finish());
  path_ = folder_ / "killed.mcap";
  EXPECT_THAT(read(), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("was not finished")));
}

TEST_F(McapFile, ASlowCameraLosesNoMoreThanASecond) {
  auto writer = McapWriter::create(path_, false).value();
  const NewMessage one = message(0, 10);
  for (const std::uint64_t time : {0, 500'000'000}) ASSERT_TRUE(writer->write({&one, 1}, time, 0));
  EXPECT_EQ(std::filesystem::file_size(path_ + ".unfinished"), 0u);
  ASSERT_TRUE(writer->write({&one, 1}, 1'000'000'000, 0));
  EXPECT_GT(std::filesystem::file_size(path_ + ".unfinished"), 0u);
}

TEST_F(McapFile, ACutFileIsReadUpToItsLastChunk) {
  write(5);
  Bytes bytes = test::read_bytes(path_);
  bytes.resize(1'700'000);
  test::write_bytes(path_, bytes);
  EXPECT_THAT(read(), ElementsAre(0, 1, 2));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("cut off")));
}

TEST_F(McapFile, ADamagedChunkIsLeftOut) {
  write(8);
  Bytes bytes = test::read_bytes(path_);
  bytes[2'000'000] ^= 0x10;
  test::write_bytes(path_, bytes);
  EXPECT_THAT(read(), ElementsAre(0, 1, 2, 6, 7));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a chunk is left out, damaged")));
}

TEST_F(McapFile, AfterADamagedLengthItGoesOnWithTheNextChunk) {
  write(8);
  Bytes bytes = test::read_bytes(path_);
  const std::string sign("\4\0\0\0zstd", 8);
  const auto chunk = std::search(bytes.begin() + 1'400'000, bytes.end(), sign.begin(), sign.end());
  ASSERT_NE(chunk, bytes.end());
  *(chunk - 30) = 0xff;  // within the length of the second chunk's record
  test::write_bytes(path_, bytes);
  EXPECT_THAT(read(), ElementsAre(0, 1, 2, 6, 7));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("bytes are damaged")));
}

TEST_F(McapFile, UnknownCompressionIsSaidWithARemedy) {
  test::ForeignMcap().chunk("lz4", 10, {1, 2, 3}).chunk("lz4", 10, {1, 2, 3}).write(path_);
  EXPECT_THAT(read(), IsEmpty());
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("2 chunks are left out, packed with lz4")));
  EXPECT_THAT(warnings_[0], HasSubstr("mcap compress"));
}

TEST_F(McapFile, AChunkThatLiesAboutItsSizeTakesNoMemory) {
  test::ForeignMcap().chunk("", 1ULL << 60, {1}).chunk("zstd", 1 << 20, {0x28, 0xb5, 0x2f, 0xfd}).write(path_);
  EXPECT_THAT(read(), IsEmpty());
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("damaged"), HasSubstr("256 MiB")));
}

TEST_F(McapFile, SomethingElseIsRefused) {
  test::write_text(path_, "no MCAP file at all");
  const auto reader = McapReader::open(path_, [](auto&&...) {});
  ASSERT_FALSE(reader);
  EXPECT_THAT(reader.error().message(), HasSubstr("is not an MCAP file"));
  EXPECT_FALSE(is_mcap(folder_.path()));
  EXPECT_FALSE(is_mcap(folder_ / "none"));
}

TEST_F(McapFile, NothingIsLeftOfAFileWithoutMessages) {
  McapWriter::create(path_, false).value().reset();
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(McapFile, AFullDiskLosesOneFrameAndKeepsTheRest) {
  auto writer = McapWriter::create(path_, false).value();
  for (int i = 0; i < 3; ++i) add(*writer, i);
  {
    const test::FileSizeLimit limit(2'000'000);
    add(*writer, 3);
    add(*writer, 4);
    const NewMessage one = message(5);
    const auto lost = writer->write({&one, 1}, 1005, 5);
    ASSERT_FALSE(lost);
    EXPECT_THAT(lost.error().message(), HasSubstr("messages before are kept"));
  }
  add(*writer, 6);
  ASSERT_TRUE(writer->finish());
  EXPECT_THAT(read(), ElementsAre(0, 1, 2, 3, 4, 6));
  EXPECT_THAT(warnings_, IsEmpty());
}

}  // namespace
}  // namespace barehand::mcap
