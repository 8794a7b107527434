#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "io/distribution.h"

namespace barehand {

/// What stands beside a chart.
struct ChartText {
  std::string title, x_label, y_label;
};

/// Boxes as in the paper's Fig. 7: median (red), quartiles (box), whole range (whiskers). One group of boxes per
/// category, one box per series in it; the legend names the series if there are several.
struct BoxChart {
  ChartText text;
  std::vector<std::string> categories;
  struct Series {
    std::string name;
    std::vector<Distribution> boxes;  ///< one per category; nothing is drawn where the count is 0
  };
  std::vector<Series> series;
};
Result<void> write_chart(const BoxChart& chart, const std::string& png_path);

/// Lines over x; NaN interrupts a line.
struct LineChart {
  ChartText text;
  struct Series {
    std::string name;
    std::vector<double> x, y;
  };
  std::vector<Series> series;
};
Result<void> write_chart(const LineChart& chart, const std::string& png_path);

}  // namespace barehand
