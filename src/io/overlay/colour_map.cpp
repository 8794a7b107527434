// Converts depth images to colours.
#include "io/overlay/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace barehand {
namespace {

constexpr int kLevels = 256;

std::array<Rgb, kLevels> turbo_colours() {
  cv::Mat levels(1, kLevels, CV_8U), bgr;
  for (int i = 0; i < kLevels; ++i) levels.at<unsigned char>(i) = static_cast<unsigned char>(i);
  cv::applyColorMap(levels, bgr, cv::COLORMAP_TURBO);
  std::array<Rgb, kLevels> colours;
  for (int i = 0; i < kLevels; ++i) {
    const auto& p = bgr.at<cv::Vec3b>(i);
    colours[i] = {p[2], p[1], p[0]};
  }
  return colours;
}

Rgb darkened(const Rgb& c) {
  return {static_cast<std::uint8_t>(c.r / 3), static_cast<std::uint8_t>(c.g / 3), static_cast<std::uint8_t>(c.b / 3)};
}

}  // namespace

ColouredDepths typical_range(const RgbdFrame& frame) {
  constexpr std::size_t kEnough = 5000;                        // pixels for the percentiles
  const std::size_t step = frame.depth.size() / kEnough | 1u;  // odd, so that the columns differ
  std::vector<std::uint16_t> counts;
  for (std::size_t i = 0; i < frame.depth.size(); i += step)
    if (frame.depth[i] > 0) counts.push_back(frame.depth[i]);
  if (counts.empty()) return {};
  const auto at = [&](double fraction) {
    const auto it = counts.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(counts.size() - 1));
    std::nth_element(counts.begin(), it, counts.end());
    return *it * frame.depth_unit;
  };
  const double near = at(0.02);
  return {near, std::max(at(0.98), near + 0.05)};
}

ColouredDepths SteadyRange::follow(const ColouredDepths& own, std::int64_t utime) {
  constexpr double kSeconds = 0.5;  // after which two thirds of a change are followed
  const double passed = static_cast<double>(utime - utime_) * 1e-6;
  utime_ = utime;
  if (!range_ || passed < 0) return range_.emplace(own);
  const double share = 1 - std::exp(-passed / kSeconds);
  range_->near += share * (own.near - range_->near);
  range_->far += share * (own.far - range_->far);
  return *range_;
}

Image<Rgb> depth_colours(const RgbdFrame& frame, const ColouredDepths& range) {
  const std::array<Rgb, kLevels> colours = turbo_colours();
  Image<Rgb> picture(frame.depth.width(), frame.depth.height());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (frame.depth[i] == 0) continue;
    const double position = (range.far - frame.depth[i] * frame.depth_unit) / (range.far - range.near);
    const Rgb& colour = colours[static_cast<int>(std::clamp(position, 0.0, 1.0) * (kLevels - 1))];
    picture[i] = position < 0 || position > 1 ? darkened(colour) : colour;
  }
  return picture;
}

}  // namespace barehand
