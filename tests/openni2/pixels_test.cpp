#include "drivers/openni2/frames/pixels.h"

#include <gtest/gtest.h>

#include <array>

namespace barehand {
namespace {

using Row = std::array<Rgb, 2>;

Row convert(const std::vector<std::uint8_t>& bytes, openni::PixelFormat format) {
  Row row;
  convert_colour_row(bytes.data(), 2, format, row.data());
  return row;
}

void expect_near(Rgb a, Rgb b) {
  EXPECT_NEAR(a.r, b.r, 2);
  EXPECT_NEAR(a.g, b.g, 2);
  EXPECT_NEAR(a.b, b.b, 2);
}

TEST(ColourFormats, Rgb) {
  EXPECT_EQ(convert({1, 2, 3, 4, 5, 6}, openni::PIXEL_FORMAT_RGB888), (Row{Rgb{1, 2, 3}, Rgb{4, 5, 6}}));
}

TEST(ColourFormats, GreyHasNoHue) {
  EXPECT_EQ(convert({7, 200}, openni::PIXEL_FORMAT_GRAY8), (Row{Rgb{7, 7, 7}, Rgb{200, 200, 200}}));
}

// Red in BT.601 is Y 81, U 90, V 240. A white with the same U and V is no longer pure red, but its blue stays low.
TEST(ColourFormats, YuvInBothOrders) {
  const Row yuyv = convert({81, 90, 81, 240}, openni::PIXEL_FORMAT_YUYV);
  const Row uyvy = convert({90, 81, 240, 81}, openni::PIXEL_FORMAT_YUV422);
  for (const Row& row : {yuyv, uyvy})
    for (const Rgb& pixel : row) expect_near(pixel, {255, 0, 0});
  expect_near(convert({235, 128, 16, 128}, openni::PIXEL_FORMAT_YUYV)[0], {255, 255, 255});
  expect_near(convert({235, 128, 16, 128}, openni::PIXEL_FORMAT_YUYV)[1], {0, 0, 0});
}

}  // namespace
}  // namespace barehand
