#include "evaluation/fingertips.h"

#include <gmock/gmock.h>

#include "support/small_hand.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::HasSubstr;

/// The index fingertip points to the left of the image at 0.5 m; its skin ends 8 mm beyond (-0.03, 0, 0.5).
TableFrame pointing_left(std::int64_t number) {
  TableFrame frame{number, 0, {}};
  for (TableRow& row : frame.rows) row = {{0, 0, 0.5}, {-0.03, 0, 0.5}, 1};
  return frame;
}

const Intrinsics kCamera{320, 240, 250, 250, 160, 120};

TEST(Fingertips, DistanceOfTheProjectedSkinTip) {
  ResultTable result{{pointing_left(3)}, false};
  const Eigen::Vector3d tip = fingertip(result.frames[0], test::small_hand(), 1);
  EXPECT_NEAR((tip - Eigen::Vector3d(-0.038, 0, 0.5)).norm(), 0, 1e-12);
  // The fingertip projects to u = 160 - 250 * 0.038 / 0.5 = 141, v = 120.
  const auto e = evaluate_fingertips({{3, 1, {144, 124}}, {3, 4, {141, 121}}, {4, 1, {0, 0}}}, {result},
                                     test::small_hand(), kCamera);
  EXPECT_EQ(e.labels, 3u);
  EXPECT_EQ(e.missing, 1u);
  EXPECT_EQ(e.all.count, 2u);
  EXPECT_NEAR(e.per_finger[1].median, 5, 1e-9);
  EXPECT_NEAR(e.per_finger[4].median, 1, 1e-9);
  EXPECT_NEAR(e.all.mean, 3, 1e-9);
}

TEST(Fingertips, RunsOverPartsOfTheRecordingAddUp) {
  const ResultTable forwards{{pointing_left(3), pointing_left(4)}, false}, backwards{{pointing_left(2)}, false};
  const std::vector<FingertipLabel> labels = {{2, 1, {141, 120}}, {4, 1, {141, 120}}, {5, 1, {141, 120}}};
  const auto e = evaluate_fingertips(labels, {forwards, backwards}, test::small_hand(), kCamera);
  EXPECT_EQ(e.all.count, 2u);
  EXPECT_EQ(e.missing, 1u);
  EXPECT_NEAR(e.all.max, 0, 1e-9);
}

TEST(Fingertips, LabelsAreReadAndHiddenOnesLeftOut) {
  const test::TempFolder folder;
  const std::string path = folder / "tips.csv";
  test::write_text(path, "frame,finger,u,v,visible\n3,thumb,195.7,95.4,1\n3,index,-1,-1,0\n18,little,99.3,74.5,1\n");

  // Visible labels are read.
  const auto labels = read_fingertip_labels(path);
  ASSERT_TRUE(labels) << labels.error().message();
  ASSERT_EQ(labels->size(), 2u);
  EXPECT_EQ((*labels)[1].frame, 18);
  EXPECT_EQ((*labels)[1].finger, 4);
  EXPECT_DOUBLE_EQ((*labels)[0].pixel.x(), 195.7);

  // Errors name the line.
  test::write_text(path, "frame,finger,u,v,visible\n3,toe,195.7,95.4,1\n");
  EXPECT_THAT(read_fingertip_labels(path).error().message(), HasSubstr("line 2"));
  for (const char* number : {"left", "nan", "-inf", "1e300"}) {
    test::write_text(path, "frame,finger,u,v,visible\n3,thumb," + std::string(number) + ",95.4,1\n");
    EXPECT_THAT(read_fingertip_labels(path).error().message(), HasSubstr("line 2")) << number;
  }
  test::write_text(path, "frame,finger,u,v,visible\n3,thumb,left,95.4,1\n");
  EXPECT_THAT(read_fingertip_labels(path).error().message(), HasSubstr("line 2"));
  test::write_text(path, "x,y\n");
  EXPECT_THAT(read_fingertip_labels(path).error().message(), HasSubstr("line 1"));
}

TEST(FingertipLabels, AreReadAsSpreadsheetsWriteThem) {
  const test::TempFolder folder;
  test::write_text(folder / "tips.csv",
                   "\xef\xbb\xbf"
                   "frame,finger,u,v,visible\r\n3,thumb,10,20,1\r\n");
  const auto labels = read_fingertip_labels(folder / "tips.csv");
  ASSERT_TRUE(labels) << labels.error().message();
  EXPECT_EQ(labels->size(), 1u);
}

}  // namespace
}  // namespace barehand
