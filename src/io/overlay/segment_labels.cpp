// Writes the names of a hand's segments next to the hand in an image.
#include "io/overlay/segment_labels.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/overlay/finger_colours.h"

namespace barehand {
namespace {

constexpr int kLineHeight = 15;  // distance of two labels in a column [px]
constexpr int kGap = 28;  // horizontal distance of the labels from the leftmost or rightmost middle of a segment [px]
constexpr double kFontScale = 0.38;

struct Label {
  std::string text;
  cv::Scalar colour;
  cv::Point segment;  // middle of the segment in the image [px]
  int v = 0;          // row of the text's centre [px]
};

/// One label for every segment whose middle lies in the image.
std::vector<Label> labels_of(const HandEstimate& estimate, const Intrinsics& camera, const cv::Size& picture) {
  std::vector<Label> labels;
  for (int s = 0; s < kSegmentCount; ++s) {
    const auto pixel = pixel_of(camera, 0.5 * (proximal_end_of(estimate, s) + distal_end_of(estimate, s)));
    if (!pixel) continue;
    const cv::Point middle(pixel->x >> kFractionBits, pixel->y >> kFractionBits);
    if (!cv::Rect({0, 0}, picture).contains(middle)) continue;
    std::string text(kSegmentNames[s]);
    std::replace(text.begin(), text.end(), '_', ' ');
    const Rgb colour = finger_colour(s);
    labels.push_back({text, cv::Scalar(colour.r, colour.g, colour.b), middle, middle.y});
  }
  return labels;
}

/// Moves the labels of a column apart, so that they neither overlap nor leave the image, if the image is high enough.
void spread(std::vector<Label>& column, int height) {
  std::stable_sort(column.begin(), column.end(), [](const Label& a, const Label& b) { return a.v < b.v; });
  int lowest = kLineHeight;
  for (Label& label : column) {
    label.v = std::max(label.v, lowest);
    lowest = label.v + kLineHeight;
  }
  int highest = height - kLineHeight;
  for (auto label = column.rbegin(); label != column.rend(); ++label) {
    label->v = std::min(label->v, highest);
    highest = label->v - kLineHeight;
  }
}

/// Draws a column of labels to the left or right of `edge`, the column of pixels at its inner side.
void draw_column(const std::vector<Label>& column, int edge, bool to_left, cv::Mat& picture) {
  for (const Label& label : column) {
    // Place the text next to the edge, but within the image.
    const cv::Size size = cv::getTextSize(label.text, cv::FONT_HERSHEY_SIMPLEX, kFontScale, 1, nullptr);
    const int left = std::clamp(to_left ? edge - size.width : edge, 2, std::max(2, picture.cols - size.width - 2));
    const cv::Point text(left, label.v + size.height / 2), joint(to_left ? left + size.width + 2 : left - 2, label.v);

    // Draw the line, then the text with a dark rim, which keeps it legible over any image.
    cv::line(picture, label.segment, joint, label.colour, 1, cv::LINE_AA);
    for (const auto& [colour, thickness] : {std::pair{cv::Scalar(20, 20, 20), 3}, {label.colour, 1}})
      cv::putText(picture, label.text, text, cv::FONT_HERSHEY_SIMPLEX, kFontScale, colour, thickness, cv::LINE_AA);
  }
}

}  // namespace

void draw_segment_names(const HandEstimate& estimate, const Intrinsics& camera, cv::Mat& picture) {
  std::vector<Label> labels = labels_of(estimate, camera, picture.size());
  if (labels.empty()) return;

  // Put the labels of the left half of the segments into the left column, the others into the right one.
  std::stable_sort(labels.begin(), labels.end(),
                   [](const Label& a, const Label& b) { return a.segment.x < b.segment.x; });
  const auto middle = labels.begin() + static_cast<std::ptrdiff_t>(labels.size() / 2);
  const int left_edge = labels.front().segment.x - kGap, right_edge = labels.back().segment.x + kGap;

  // Spread the labels over the height of the picture, and draw them.
  std::vector<Label> on_left(labels.begin(), middle), on_right(middle, labels.end());
  spread(on_left, picture.rows);
  spread(on_right, picture.rows);
  draw_column(on_left, left_edge, true, picture);
  draw_column(on_right, right_edge, false, picture);
}

}  // namespace barehand
