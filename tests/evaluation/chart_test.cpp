#include "evaluation/chart.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "io/recording/image_file.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

/// Rows that contain a pixel of nearly this colour, which shows where something was drawn in it.
std::vector<int> rows_of(const Image<Rgb>& image, Rgb colour) {
  std::vector<int> rows;
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u) {
      const Rgb& p = image.at(u, v);
      if (std::abs(p.r - colour.r) + std::abs(p.g - colour.g) + std::abs(p.b - colour.b) > 30) continue;
      rows.push_back(v);
      break;
    }
  return rows;
}

constexpr Rgb kMedianRed{220, 30, 30};

Image<Rgb> box_chart(const std::string& path, double median) {
  BoxChart chart{{"title", "", "mm"}, {"a", "b"}, {{"run", {summarise({0, median, 10}), {}}}}};
  EXPECT_TRUE(write_chart(chart, path));
  return *read_colour(path);
}

TEST(Chart, MedianStandsAtItsHeight) {
  const test::TempFolder folder;
  const auto low = rows_of(box_chart(folder / "low.png", 2), kMedianRed);
  const auto high = rows_of(box_chart(folder / "high.png", 8), kMedianRed);
  ASSERT_FALSE(low.empty());
  ASSERT_FALSE(high.empty());
  // From 0 to 10, the axis is 470 pixels high.
  EXPECT_NEAR(low.front() - high.front(), 0.6 * 470, 3);
}

TEST(Chart, LineIsInterruptedWhereThereIsNoValue) {
  const test::TempFolder folder;
  const auto blue_pixels = [&](std::vector<double> y) {
    LineChart chart{{"title", "frame", "mm"}, {{"run", {0, 1, 2, 3}, std::move(y)}}};
    EXPECT_TRUE(write_chart(chart, folder / "time.png"));
    const Image<Rgb> image = *read_colour(folder / "time.png");
    int count = 0;
    for (std::size_t i = 0; i < image.size(); ++i) count += image[i] == Rgb{0, 114, 178};
    return count;
  };
  EXPECT_GT(blue_pixels({5, 5, 5, 5}), 2 * blue_pixels({5, 5, NAN, 5}));
  EXPECT_LT(blue_pixels({NAN, 5, NAN, 5}), 60) << "two dots";
  EXPECT_GT(blue_pixels({NAN, 5, NAN, 5}), 0);
}

TEST(Chart, HasItsNameOnlyWhenItIsWhole) {
  const test::TempFolder folder;
  test::write_text(folder / "old.png", "the one before");
  std::filesystem::create_hard_link(folder / "old.png", folder / "time.png");
  ASSERT_TRUE(write_chart(LineChart{{"title", "frame", "mm"}, {{"run", {0, 1}, {5, 5}}}}, folder / "time.png"));
  EXPECT_TRUE(read_colour(folder / "time.png"));
  EXPECT_EQ(test::read_text(folder / "old.png"), "the one before") << "it was written over instead of replaced";
  EXPECT_FALSE(std::filesystem::exists(folder / "time.png.unfinished"));
}

TEST(Chart, FolderThatIsNotThereIsAnError) { EXPECT_FALSE(write_chart(LineChart{}, "/no/such/folder/time.png")); }

}  // namespace
}  // namespace barehand
