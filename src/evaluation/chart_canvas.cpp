// The canvas of a chart: axes, scales, text and colours.
#include "evaluation/chart_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/format.h"
#include "io/atomic_file.h"
#include "io/recording/png_codec.h"

namespace barehand {
namespace {

constexpr int kWidth = 1120, kHeight = 620;
constexpr int kLeft = 90, kRight = 30, kTop = 84;
constexpr double kLabel = 0.5, kUprightLabel = 0.42;  // font scales of horizontal and upright labels
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
const cv::Scalar kInk(40, 40, 40), kGrid(225, 225, 225);
/// Colours (BGR) that most colour-blind people can distinguish (Okabe and Ito).
const std::array<cv::Scalar, 8> kColours = {cv::Scalar(178, 114, 0), {0, 94, 213},   {115, 158, 0},  {167, 121, 204},
                                            {0, 159, 230},           {233, 180, 86}, {66, 228, 240}, {90, 90, 90}};

std::string number_text(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return formatted("%.*f", decimals, value);
}

cv::Size text_size(const std::string& text, double scale) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, scale, 1, &baseline);
}

}  // namespace

double round_step(double range, int count) {
  const double raw = range / count;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

ChartCanvas::ChartCanvas(const ChartText& text, double x_lo, double x_hi, double y_hi,
                         const std::vector<std::string>& categories)
    : image_(kHeight, kWidth, CV_8UC3, cv::Scalar::all(255)), x_lo_(x_lo), x_hi_(x_hi > x_lo ? x_hi : x_lo + 1) {
  // Let the range of y end at a full step.
  const double top = y_hi > 0 ? y_hi : 1;
  y_step_ = round_step(top, 7);
  y_hi_ = y_step_ * std::ceil(top / y_step_ - 1e-9);

  // Write long category names upright, which needs more space below the frame.
  const int room = (kWidth - kLeft - kRight) / static_cast<int>(std::max<std::size_t>(categories.size(), 1));
  upright_ = std::any_of(categories.begin(), categories.end(),
                         [&](const std::string& name) { return text_size(name, kLabel).width > room - 8; });
  bottom_ = upright_ ? 150 : 66;

  // Draw the title and the axes.
  text_centred(text.title, {kWidth / 2, 24}, 0.7);
  text_centred(text.x_label, {(kLeft + kWidth - kRight) / 2, kHeight - 18}, 0.55);
  y_axis(text.y_label);
  if (categories.empty())
    x_ticks();
  else
    x_categories(categories);
}

cv::Point ChartCanvas::at(double x, double y) const {
  const double u = kLeft + (x - x_lo_) / (x_hi_ - x_lo_) * (kWidth - kLeft - kRight);
  const double v = kHeight - bottom_ - y / y_hi_ * (kHeight - kTop - bottom_);
  return {static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v))};
}

void ChartCanvas::line(cv::Point a, cv::Point b, const cv::Scalar& colour, int thickness) {
  cv::line(image_, a, b, colour, thickness, cv::LINE_AA);
}

void ChartCanvas::box(cv::Point a, cv::Point b, const cv::Scalar& colour) {
  cv::rectangle(image_, a, b, colour * 0.35 + cv::Scalar::all(255 * 0.65), cv::FILLED);
  cv::rectangle(image_, a, b, colour, 1);
}

void ChartCanvas::y_axis(const std::string& label) {
  for (int i = 0; i * y_step_ <= y_hi_ * (1 + 1e-9); ++i) {
    const double y = i * y_step_;
    line(at(x_lo_, y), at(x_hi_, y), kGrid);
    const std::string text = number_text(y, y_step_);
    const cv::Size size = text_size(text, 0.5);
    cv::putText(image_, text, at(x_lo_, y) + cv::Point(-10 - size.width, size.height / 2), kFont, 0.5, kInk, 1,
                cv::LINE_AA);
  }
  cv::rectangle(image_, at(x_lo_, y_hi_), at(x_hi_, 0), kInk, 1);
  const cv::Size size = text_size(label, 0.55);
  text_upright(label, {22, (kTop + kHeight - bottom_ - size.width) / 2}, 0.55);
}

void ChartCanvas::x_ticks() {
  const double step = round_step(x_hi_ - x_lo_, 10);
  for (double x = step * std::ceil(x_lo_ / step); x <= x_hi_ + 1e-9 * step; x += step) {
    const cv::Point foot = at(x, 0);
    line(foot, foot + cv::Point(0, 6), kInk);
    text_centred(number_text(x, step), foot + cv::Point(0, 20), 0.5);
  }
}

void ChartCanvas::x_categories(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const cv::Point foot = at(static_cast<double>(i), 0);
    if (upright_)
      text_upright(names[i], foot + cv::Point(0, 8), kUprightLabel);
    else
      text_centred(names[i], foot + cv::Point(0, 20), kLabel);
  }
}

void ChartCanvas::dot(cv::Point centre, const cv::Scalar& colour) {
  cv::circle(image_, centre, 2, colour, cv::FILLED, cv::LINE_AA);
}

void ChartCanvas::legend(const std::vector<std::string>& names) {
  constexpr int kSample = 30, kGap = 24;
  int width = -kGap;
  for (const std::string& name : names) width += kSample + text_size(name, kLabel).width + kGap;
  cv::Point at((kLeft + kWidth - kRight - width) / 2, 60);
  for (std::size_t i = 0; i < names.size(); ++i) {
    line(at, at + cv::Point(kSample - 8, 0), series_colour(i), 3);
    cv::putText(image_, names[i], at + cv::Point(kSample, 5), kFont, kLabel, kInk, 1, cv::LINE_AA);
    at.x += kSample + text_size(names[i], kLabel).width + kGap;
  }
}

void ChartCanvas::text_centred(const std::string& text, cv::Point centre, double scale) {
  const cv::Size size = text_size(text, scale);
  cv::putText(image_, text, centre + cv::Point(-size.width / 2, size.height / 2), kFont, scale, kInk, 1, cv::LINE_AA);
}

void ChartCanvas::text_upright(const std::string& text, cv::Point top_centre, double scale) {
  const cv::Size size = text_size(text, scale);
  // Draw the text on a separate strip, and rotate the strip.
  cv::Mat strip(size.height + 10, size.width + 2, CV_8UC3, cv::Scalar::all(255));
  cv::putText(strip, text, {1, size.height + 3}, kFont, scale, kInk, 1, cv::LINE_AA);
  cv::rotate(strip, strip, cv::ROTATE_90_COUNTERCLOCKWISE);

  // Copy only the part that lies within the image.
  const cv::Rect place(top_centre.x - strip.cols / 2, top_centre.y, strip.cols, strip.rows);
  const cv::Rect inside = place & cv::Rect(0, 0, image_.cols, image_.rows);
  strip(inside - place.tl()).copyTo(image_(inside));
}

Result<void> ChartCanvas::write(const std::string& path) const {
  Image<Rgb> picture(image_.cols, image_.rows);
  cv::cvtColor(image_, cv::Mat(image_.rows, image_.cols, CV_8UC3, picture.data()), cv::COLOR_BGR2RGB);
  const auto png = encode_png(picture);
  if (!png) return fail(png.error().what, path, png.error().remedy);
  return write_file_atomically(path, {reinterpret_cast<const char*>(png->data()), png->size()});
}

cv::Scalar ChartCanvas::series_colour(std::size_t index) { return kColours[index % kColours.size()]; }

}  // namespace barehand
