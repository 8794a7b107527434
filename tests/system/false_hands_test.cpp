#include <gmock/gmock.h>

#include "io/hand/result_table.h"
#include "support/child_process.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

/// Frames of a simulated scene in which some hand is tracked, with the mean hands of both sides.
std::vector<std::int64_t> tracked_frames(const std::string& scene) {
  const test::TempFolder folder;
  ChildProcess child({BAREHAND_PROGRAM, "track", "--source", "sim:" + scene + ",noise=kinect", "--hand", "both",
                      "--no-publish", "--threads", "1", "--result", folder / "hand.csv"});
  EXPECT_EQ(child.finish(), 0) << child.output();
  std::vector<std::int64_t> frames;
  for (const char* name : {"hand.csv", "hand_left.csv"}) {
    const auto table = read_table(folder / name);
    EXPECT_TRUE(table) << table.error().message();
    if (!table) continue;
    for (const TableFrame& frame : table->frames) frames.push_back(frame.number);
  }
  return frames;
}

TEST(FalseHands, NoHandIsTrackedWhereThereIsNone) {
  EXPECT_THAT(tracked_frames("feet,seed=1,frames=20"), testing::IsEmpty());
  EXPECT_THAT(tracked_frames("empty_person,seed=1,frames=20"), testing::IsEmpty());
}

TEST(FalseHands, APersonsHandIsTrackedWithinFiveFrames) {
  EXPECT_THAT(tracked_frames("person,seed=1,frames=6"), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace barehand
