#include "stages/preprocess/image/window_sum.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

namespace barehand {
namespace {

TEST(WindowSum, AgreesWithABoxFilter) {
  std::mt19937 random(3);
  WindowSum<float> sum;
  for (const int radius : {0, 1, 2, 10}) {
    Image<float> in(31 + radius, 17), out;  // the last window is higher than the image
    for (std::size_t i = 0; i < in.size(); ++i)
      in[i] = static_cast<float>(random() % 2001) - 1000.f;  // integers, so that sums are exact
    sum.compute(in, radius, out);
    cv::Mat expected;
    cv::boxFilter(cv::Mat(in.height(), in.width(), CV_32F, in.data()), expected, -1, {2 * radius + 1, 2 * radius + 1},
                  {-1, -1}, false, cv::BORDER_CONSTANT);
    for (int v = 0; v < in.height(); ++v)
      for (int u = 0; u < in.width(); ++u) ASSERT_EQ(out.at(u, v), expected.at<float>(v, u)) << radius;
  }
}

TEST(WindowSum, CountsFlags) {
  Image<std::uint8_t> flags(50, 30, 1);
  Image<std::uint16_t> count;
  WindowSum<std::uint16_t>().compute(flags, 10, count);
  EXPECT_EQ(count.at(25, 15), 21 * 21);  // exceeds the range of a byte
  EXPECT_EQ(count.at(0, 0), 11 * 11);
}

TEST(WindowSum, NothingIsLeftOfWhatTheWindowHasPassed) {
  Image<float> in(40, 40), out;
  in.at(3, 3) = 1.1f, in.at(4, 3) = 1e7f, in.at(5, 4) = -0.3f;
  WindowSum<float>().compute(in, 2, out);
  EXPECT_EQ(out.at(20, 3), 0.f);
  EXPECT_EQ(out.at(4, 20), 0.f);
  EXPECT_EQ(out.at(1, 3), 1.1f);
}

}  // namespace
}  // namespace barehand
