#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "evaluation/distribution.h"

namespace barehand {

// Charts that are drawn into PNG files.

/// Title and axis labels of a chart.
struct ChartText {
  std::string title, x_label, y_label;
};

/// Box plots as in the paper's Fig. 7: median (red), quartiles (box) and whole range (whiskers). There is one group of
/// boxes per category with one box per series. The legend names the series if there are several.
struct BoxChart {
  ChartText text;
  std::vector<std::string> categories;
  struct Series {
    std::string name;
    std::vector<Distribution> boxes;  ///< one per category; a box with a count of 0 is not drawn
  };
  std::vector<Series> series;
};
/// Draws the chart into a PNG file. Errors: a file that cannot be written.
Result<void> write_chart(const BoxChart& chart, const std::string& png_path);

/// Lines over x; a NaN in y interrupts a line.
struct LineChart {
  ChartText text;
  struct Series {
    std::string name;
    std::vector<double> x, y;
  };
  std::vector<Series> series;
};
/// Draws the chart into a PNG file. Errors: a file that cannot be written.
Result<void> write_chart(const LineChart& chart, const std::string& png_path);

}  // namespace barehand
