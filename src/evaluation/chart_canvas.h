#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "evaluation/chart.h"

namespace barehand {

/// A white sheet with a frame, axes with round numbers, title, labels and legend, on which charts are drawn. In data
/// coordinates, y points upwards.
class ChartCanvas {
 public:
  /// x runs from `x_lo` to `x_hi`, y from 0 to at least `y_hi`. Category i is written below x = i, upright if the names
  /// are too long; without categories, the x axis shows round numbers.
  ChartCanvas(const ChartText& text, double x_lo, double x_hi, double y_hi,
              const std::vector<std::string>& categories = {});

  /// The pixel at the data coordinates (x, y).
  cv::Point at(double x, double y) const;
  void line(cv::Point a, cv::Point b, const cv::Scalar& colour, int thickness = 1);
  /// A box filled with a light tint of its outline's colour.
  void box(cv::Point a, cv::Point b, const cv::Scalar& colour);
  void dot(cv::Point centre, const cv::Scalar& colour);
  /// Writes the legend in one row above the frame.
  void legend(const std::vector<std::string>& names);
  /// Writes the image as PNG. Error: the file cannot be written.
  Result<void> write(const std::string& path) const;

  /// The colour of a series; colours repeat after eight.
  static cv::Scalar series_colour(std::size_t index);

 private:
  void y_axis(const std::string& label);
  void x_ticks();
  void x_categories(const std::vector<std::string>& names);
  void text_centred(const std::string& text, cv::Point centre, double scale);
  void text_upright(const std::string& text, cv::Point top_centre, double scale);

  cv::Mat image_;
  double x_lo_, x_hi_, y_hi_, y_step_;
  bool upright_;  ///< whether the categories' names are too long to be written side by side
  int bottom_;    ///< height of the space below the frame [pixels]
};

/// The step of an axis with about `count` steps over `range`: 1, 2 or 5 times a power of ten.
double round_step(double range, int count);

}  // namespace barehand
