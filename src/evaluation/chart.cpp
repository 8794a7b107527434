// Draws box plots and line charts into PNG files.
#include "evaluation/chart.h"

#include <algorithm>
#include <cmath>

#include "evaluation/chart_canvas.h"

namespace barehand {
namespace {

constexpr double kGroupWidth = 0.7;  // width of a group of boxes, relative to that of a category

/// Draws one box with its whiskers; `half_width` in units of x.
void draw_box(ChartCanvas& canvas, double x, double half_width, const Distribution& d, const cv::Scalar& colour) {
  const cv::Scalar red(30, 30, 220);
  canvas.line(canvas.at(x, d.min), canvas.at(x, d.max), colour);
  for (double end : {d.min, d.max})
    canvas.line(canvas.at(x - half_width / 2, end), canvas.at(x + half_width / 2, end), colour);
  canvas.box(canvas.at(x - half_width, d.quartile3), canvas.at(x + half_width, d.quartile1), colour);
  canvas.line(canvas.at(x - half_width, d.median), canvas.at(x + half_width, d.median), red, 2);
}

template <typename Series>
std::vector<std::string> names_of(const std::vector<Series>& series) {
  std::vector<std::string> names;
  for (const Series& s : series) names.push_back(s.name);
  return names;
}

}  // namespace

Result<void> write_chart(const BoxChart& chart, const std::string& png_path) {
  // Find the range of the values.
  double top = 0;
  for (const auto& series : chart.series)
    for (const Distribution& box : series.boxes)
      if (box.count > 0) top = std::max(top, box.max);

  // Every category gets the same width, which is divided among the series.
  const auto categories = static_cast<double>(chart.categories.size());
  ChartCanvas canvas(chart.text, -0.6, categories - 0.4, top, chart.categories);
  const double room = kGroupWidth / static_cast<double>(std::max<std::size_t>(chart.series.size(), 1));

  // Draw a box for every series in every category in which it has values.
  for (std::size_t s = 0; s < chart.series.size(); ++s)
    for (std::size_t c = 0; c < chart.series[s].boxes.size(); ++c) {
      const Distribution& box = chart.series[s].boxes[c];
      const double x = static_cast<double>(c) - kGroupWidth / 2 + (static_cast<double>(s) + 0.5) * room;
      if (box.count > 0) draw_box(canvas, x, 0.4 * room, box, ChartCanvas::series_colour(s));
    }

  // Name the series only if there are several to tell apart.
  if (chart.series.size() > 1) canvas.legend(names_of(chart.series));
  return canvas.write(png_path);
}

Result<void> write_chart(const LineChart& chart, const std::string& png_path) {
  // Find the ranges of x and y.
  double top = 0, x_lo = INFINITY, x_hi = -INFINITY;
  for (const auto& series : chart.series)
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      x_lo = std::min(x_lo, series.x[i]);
      x_hi = std::max(x_hi, series.x[i]);
      if (std::isfinite(series.y[i])) top = std::max(top, series.y[i]);
    }

  // Show an empty range of x as 0 to 1.
  if (x_lo > x_hi) x_lo = 0, x_hi = 1;

  // Draw line by line; a point without neighbours becomes a dot.
  ChartCanvas canvas(chart.text, x_lo, x_hi, top);
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const auto& [name, x, y] = chart.series[s];
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!std::isfinite(y[i])) continue;

      // Connect the point with the one before it, if that one has a value.
      const cv::Scalar colour = ChartCanvas::series_colour(s);
      if (i > 0 && std::isfinite(y[i - 1]))
        canvas.line(canvas.at(x[i - 1], y[i - 1]), canvas.at(x[i], y[i]), colour, 2);
      else
        canvas.dot(canvas.at(x[i], y[i]), colour);
    }
  }

  // Name the series only if there are several to tell apart.
  if (chart.series.size() > 1) canvas.legend(names_of(chart.series));
  return canvas.write(png_path);
}

}  // namespace barehand
