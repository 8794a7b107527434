#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/chart.h"

namespace barehand {

/// White sheet with a frame, axes that start at round numbers, and a legend. Data coordinates have y upwards.
class ChartCanvas {
 public:
  /// x from `x_lo` to `x_hi`, y from 0 to at least `y_hi`. Category i stands below x = i, upright where there are many;
  /// without categories x has round numbers.
  ChartCanvas(const ChartText& text, double x_lo, double x_hi, double y_hi,
              const std::vector<std::string>& categories = {});

  cv::Point at(double x, double y) const;
  void line(cv::Point a, cv::Point b, const cv::Scalar& colour, int thickness = 1);
  /// Filled with a light tint of its outline.
  void box(cv::Point a, cv::Point b, const cv::Scalar& colour);
  void dot(cv::Point centre, const cv::Scalar& colour);
  /// One row above the frame.
  void legend(const std::vector<std::string>& names);
  Result<void> write(const std::string& path) const;

  /// The colour of a series; they repeat after eight.
  static cv::Scalar series_colour(std::size_t index);

 private:
  void y_axis(const std::string& label);
  void x_ticks();
  void x_categories(const std::vector<std::string>& names);
  void text_centred(const std::string& text, cv::Point centre, double scale);
  void text_upright(const std::string& text, cv::Point top_centre, double scale);

  cv::Mat image_;
  double x_lo_, x_hi_, y_hi_, y_step_;
  bool upright_;  ///< categories too long to stand side by side
  int bottom_;    ///< pixels below the frame
};

/// 1, 2 or 5 times a power of ten, about `range / count`.
double round_step(double range, int count);

}  // namespace barehand
