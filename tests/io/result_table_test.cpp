#include "io/hand/result_table.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "support/resource_limit.h"
#include "support/small_hand.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TableFrame numbered_frame(std::int64_t number) {
  TableFrame frame{number, 1 + 0.04 * static_cast<double>(number), {}};
  for (int s = 0; s < kSegmentCount; ++s)
    frame.rows[s] = {{0.001 * s, -0.002, 0.5}, {0.001 * s, -0.002 + 1e-6, 0.51}, 1.0 / (s + 1)};
  return frame;
}

class Table : public testing::Test {
 protected:
  void write(std::initializer_list<std::int64_t> numbers) {
    auto writer = TableWriter::create(path_, true);
    ASSERT_TRUE(writer);
    for (std::int64_t number : numbers) ASSERT_TRUE(writer->write(numbered_frame(number)));
    ASSERT_TRUE(writer->finish());
  }
  std::string error_of(const std::string& text) {
    test::write_text(path_, text);
    const auto table = read_table(path_);
    return table ? "accepted" : table.error().message();
  }
  test::TempFolder folder_;
  std::string path_ = folder_ / "result.csv";
};

TEST_F(Table, GoldenRows) {
  write({7});
  EXPECT_THAT(test::read_text(path_),
              testing::StartsWith("frame,timestamp,segment,px,py,pz,dx,dy,dz,visible\n"
                                  "7,1.280000,palm,0.000000,-0.002000,0.500000,0.000000,-0.001999,0.510000,1.000000\n"
                                  "7,1.280000,thumb_metacarpal,0.001000,-0.002000,0.500000,0.001000,-0.001999,"
                                  "0.510000,0.500000\n"));
}

TEST_F(Table, WhatIsWrittenComesBackInItsOrder) {
  write({5, 3, 4});
  const auto table = read_table(path_);
  ASSERT_TRUE(table) << table.error().message();
  EXPECT_FALSE(table->truncated);
  ASSERT_EQ(table->frames.size(), 3u);
  EXPECT_EQ(table->frames[1].number, 3);
  EXPECT_NEAR(table->frames[1].timestamp, 1.12, 1e-9);
  EXPECT_NEAR(table->frames[2].rows[15].proximal.x(), 0.015, 1e-9);
  EXPECT_NEAR(table->frames[2].rows[15].visible, 0.0625, 1e-9);
}

TEST_F(Table, EstimateGivesBothEndsAndALostHandGivesNoRows) {
  HandEstimate estimate;
  estimate.number = 4;
  estimate.utime = 2'500'000;
  estimate.status = TrackStatus::tracking;
  estimate.profile = std::make_shared<HandProfile>(test::small_hand());
  for (SegmentState& state : estimate.segments) state.T_camera_segment.t = {0, 0, 0.6};
  estimate.segments[6].T_camera_segment.R = exp_so3({0, M_PI / 2, 0});  // -z of the segment is -x of the camera
  estimate.segments[6].visible = 0.25;
  auto writer = TableWriter::create(path_);
  ASSERT_TRUE(writer->write(estimate));
  for (TrackStatus status : {TrackStatus::searching, TrackStatus::lost}) {
    ++estimate.number;
    estimate.status = status;
    ASSERT_TRUE(writer->write(estimate));
  }
  ASSERT_TRUE(writer->finish());
  const auto table = read_table(path_);
  ASSERT_TRUE(table) << table.error().message();
  ASSERT_EQ(table->frames.size(), 1u);
  const TableRow& row = table->frames[0].rows[6];
  EXPECT_NEAR((row.distal - Eigen::Vector3d(-0.03, 0, 0.6)).norm(), 0, 1e-6);
  EXPECT_DOUBLE_EQ(row.visible, 0.25);
  EXPECT_DOUBLE_EQ(table->frames[0].timestamp, 2.5);
}

TEST_F(Table, FinishedFramesSurviveACrashAtAnyByte) {
  write({0, 1});
  const std::string whole = test::read_text(path_);
  const std::size_t second = whole.find("\n1,") + 1;
  for (std::size_t cut = second + 1; cut + 10 < whole.size(); cut += 13) {
    test::write_text(path_, whole.substr(0, cut));
    const auto table = read_table(path_);
    ASSERT_TRUE(table) << table.error().message();
    EXPECT_EQ(table->frames.size(), 1u);
    EXPECT_TRUE(table->truncated);
  }
}

TEST_F(Table, RowsAreOnDiskWhileTheWriterIsStillOpen) {
  auto writer = TableWriter::create(path_);
  ASSERT_TRUE(writer->write(numbered_frame(0)));
  EXPECT_EQ(read_table(path_ + ".unfinished")->frames.size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(path_)) << "not whole yet";
}

TEST_F(Table, IsThereWithoutFramesOnlyIfFinished) {
  EXPECT_TRUE(TableWriter::create(path_));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  EXPECT_TRUE(TableWriter::create(path_)->finish());
  EXPECT_TRUE(read_table(path_)->frames.empty());
}

TEST_F(Table, AnotherIsReplacedOnlyIfAllowed) {
  write({0});
  EXPECT_FALSE(TableWriter::create(path_));
  EXPECT_EQ(read_table(path_)->frames.size(), 1u);
  write({0, 1});
  EXPECT_EQ(read_table(path_)->frames.size(), 2u);
}

TEST_F(Table, FullDiskIsReported) {
  EXPECT_FALSE(TableWriter::create("/dev/full"));
  EXPECT_FALSE(TableWriter::create(folder_ / "no/such/folder.csv"));
}

TEST_F(Table, OnADiskThatIsFullAtFirstTheHeaderComesWithTheRows) {
  auto writer = [&] {
    const test::FileSizeLimit full(10);
    auto created = TableWriter::create(path_);
    EXPECT_TRUE(created);
    EXPECT_FALSE(created->write(numbered_frame(0)));
    return created;
  }();
  ASSERT_TRUE(writer->write(numbered_frame(1)));
  ASSERT_TRUE(writer->finish());
  const auto table = read_table(path_);
  ASSERT_TRUE(table) << table.error().message();
  ASSERT_EQ(table->frames.size(), 1u);
  EXPECT_EQ(table->frames[0].number, 1);
}

TEST_F(Table, OnADiskThatStaysFullThereIsNone) {
  const test::FileSizeLimit full(10);
  auto writer = TableWriter::create(path_);
  ASSERT_TRUE(writer);
  const auto finished = writer->finish();
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().message(), HasSubstr("free some space"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(Table, GoesOnWithTheNextFrameWhenThereIsRoomAgain) {
  auto writer = TableWriter::create(path_);
  ASSERT_TRUE(writer->write(numbered_frame(0)));
  const auto whole = std::filesystem::file_size(path_ + ".unfinished");
  {
    const test::FileSizeLimit full(whole + 500);  // some rows of a frame
    for (int number : {1, 2}) {
      const auto written = writer->write(numbered_frame(number));
      ASSERT_FALSE(written);
      EXPECT_THAT(written.error().message(), HasSubstr("free some space"));
      EXPECT_EQ(std::filesystem::file_size(path_ + ".unfinished"), whole) << "no part of a frame is left";
    }
  }
  ASSERT_TRUE(writer->write(numbered_frame(3)));
  ASSERT_TRUE(writer->finish());
  const auto table = read_table(path_);
  ASSERT_TRUE(table) << table.error().message();
  EXPECT_FALSE(table->truncated);
  ASSERT_EQ(table->frames.size(), 2u);
  EXPECT_EQ(table->frames[1].number, 3);
}

TEST_F(Table, StampsInAnotherUnitAreNamed) {
  write({0});
  const std::string good = test::read_text(path_);
  EXPECT_THAT(
      error_of(good + "1,1700000000000,palm,0,0,0,0,0,0,1\n"),
      AllOf(HasSubstr("line 18"), HasSubstr("1.7e+12"),
            HasSubstr("looks like milliseconds since the epoch, but stamps are in seconds: divide it by 1000")));
  EXPECT_THAT(error_of(good + "1,1.7e15,palm,0,0,0,0,0,0,1\n"), HasSubstr("microseconds"));
  EXPECT_THAT(error_of(good + "1,-1e300,palm,0,0,0,0,0,0,1\n"), HasSubstr("no recording is from that time"));
}

TEST_F(Table, BadLinesAreNamed) {
  write({0, 1});
  const std::string good = test::read_text(path_);
  EXPECT_THAT(error_of("time,x\n"), HasSubstr("line 1"));
  EXPECT_THAT(error_of(good + "2,1.0,palm,0,0,0\n"), AllOf(HasSubstr("line 34"), HasSubstr("2,1.0,palm")));
  EXPECT_THAT(error_of(good + "2,1.0,foot,0,0,0,0,0,0,1\n"), HasSubstr("line 34"));
  EXPECT_THAT(error_of(good + "2,1.0,palm,nan,0,0,0,0,0,1\n"), HasSubstr("line 34"));
  EXPECT_THAT(error_of(good + "2,1.0,palm,1e300,0,0,0,0,0,1\n"), HasSubstr("line 34"));
  EXPECT_THAT(error_of(good + "2,nan,palm,0,0,0,0,0,0,1\n"), HasSubstr("line 34"));
  EXPECT_THAT(error_of(good + "9223372036854775807,1.0,palm,0,0,0,0,0,0,1\n"), HasSubstr("line 34"));
  EXPECT_THAT(error_of(good + "1,1.0,palm,0,0,0,0,0,0,1\n"), HasSubstr("frame 1 occurs twice"));
  EXPECT_THAT(error_of(good + "2,1,palm,0,0,0,0,0,0,1\n2,1,palm,0,0,0,0,0,0,1\n"), HasSubstr("palm occurs twice"));
  EXPECT_THAT(error_of(good + "2,1,palm,0,0,0,0,0,0,1\n3,1,palm,0,0,0,0,0,0,1\n"),
              AllOf(HasSubstr("line 35"), HasSubstr("frame 2 ended before")));
}

}  // namespace
}  // namespace barehand
