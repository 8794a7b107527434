// Draws the skin of tracked hands over an image.
#include "io/overlay/skin_layer.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "hand/rendering/hand_renderer.h"
#include "io/overlay/finger_colours.h"
#include "io/overlay/overlay_view.h"

namespace barehand {
namespace {

using Pixel = SkinLayer::Pixel;

// Skin at the depth `z` counts as hidden if it lies farther behind the measured surface than this [m]: the sum of the
// errors of skin and pose and of three standard deviations of a structured-light camera's noise, which grows with the
// square of the depth.
float hidden_behind(float z) { return 0.012f + 0.006f * z * z; }

/// Brightness of a vertex with this normal (camera frame), in [0, 1]: one light is at the camera, the other above it to
/// the left.
float light_of(const Eigen::Vector3f& normal) {
  const Eigen::Vector3f to_lamp = Eigen::Vector3f(-0.35f, -0.6f, -0.72f).normalized();
  return std::min(1.0f, 0.35f + 0.5f * std::max(0.0f, normal.dot(to_lamp)) + 0.2f * std::max(0.0f, -normal.z()));
}

/// Colour (R, G, B) in [0, 255], and opacity in [0, 1].
using Paint = cv::Vec4f;

Paint paint_of(const HandEstimate& estimate, int segment) {
  const float confidence = static_cast<float>(std::clamp(estimate.segments[segment].confidence, 0.0, 1.0));
  const Rgb full = finger_colour(segment);
  const float grey = (static_cast<float>(full.r) + full.g + full.b) / 3, saturation = 0.5f + 0.5f * confidence;
  const auto faded = [&](std::uint8_t channel) { return grey + saturation * (channel - grey); };
  return {faded(full.r), faded(full.g), faded(full.b), 0.3f + 0.4f * confidence};
}

/// The shaded colour and the opacity of every vertex; near a joint, those of the two segments are mixed.
std::vector<Paint> vertex_paints(const HandEstimate& estimate, const Skin& skin, const RenderedHand& rendered) {
  std::array<Paint, kSegmentCount> paints;
  for (int s = 0; s < kSegmentCount; ++s) paints[s] = paint_of(estimate, s);

  std::vector<Paint> mixed(skin.vertices.size());
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    const SkinVertex& v = skin.vertices[i];
    const float light = light_of(rendered.normal[i]);
    const float share_b = std::max(0.0f, 3 * v.weight_b - 1);  // colours mix in a narrower zone than the skin bends
    mixed[i] = (paints[v.a] * (1 - share_b) + paints[v.b] * share_b).mul({light, light, light, 1});
  }
  return mixed;
}

/// Adds the skin of one hand to the pixels in which it is in front of the skin added before.
void add_hand(const DrawnHand& hand, std::uint8_t number, const RenderedHand& rendered, SkinLayer& layer) {
  // Colour the vertices, and start with an empty rectangle, which grows with each pixel of skin.
  const std::vector<Paint> paints = vertex_paints(hand.estimate, hand.skin, rendered);
  int left = rendered.grid.width, right = 0, top = rendered.grid.height, bottom = 0;
  for (int v = 0; v < rendered.grid.height; ++v) {
    for (int u = 0; u < rendered.grid.width; ++u) {
      const float z = rendered.depth.at(u, v);
      Pixel& p = layer.pixels.at(u, v);
      if (z == 0 || (p.z > 0 && p.z <= z)) continue;

      // Set the pixel, and extend the rectangle that contains skin.
      const std::int32_t vertex = rendered.vertex.at(u, v);
      const Paint& paint = paints[vertex];
      const int segment = hand.skin.vertices[vertex].a;
      p = {z,      {paint[0], paint[1], paint[2]},     paint[3],
           number, static_cast<std::uint8_t>(segment), !is_measured(hand.estimate, segment),
           false};
      left = std::min(left, u), right = std::max(right, u + 1);
      top = std::min(top, v), bottom = std::max(bottom, v + 1);
    }
  }

  // Add the rectangle to the part of the picture that has skin.
  if (left < right) layer.part |= cv::Rect(left, top, right - left, bottom - top);
}

/// Calls `visit(pixel, row, column)` for all pixels of `layer.part`; row and column count from its top left corner.
template <typename Visit>
void for_each_pixel(SkinLayer& layer, Visit&& visit) {
  for (int v = 0; v < layer.part.height; ++v) {
    Pixel* row = layer.pixels.row(layer.part.y + v) + layer.part.x;
    for (int u = 0; u < layer.part.width; ++u) visit(row[u], v, u);
  }
}

/// Smooths the colours and opacities of the pixels with skin, which are constant around each vertex.
void smooth_paint(int scale, SkinLayer& layer) {
  // Blur the colours and opacities together with the coverage (1 where there is skin, otherwise 0).
  using PaintAndCoverage = cv::Vec<float, 5>;
  cv::Mat_<PaintAndCoverage> paint(layer.part.size());
  for_each_pixel(layer, [&](const Pixel& p, int v, int u) {
    paint(v, u) = p.z > 0 ? PaintAndCoverage(p.colour[0], p.colour[1], p.colour[2], p.opacity, 1) : PaintAndCoverage();
  });
  const int width = 4 * scale + 1;
  cv::blur(paint, paint, {width, width});

  // Divide by the blurred coverage, which gives the mean over the pixels with skin in the neighbourhood.
  for_each_pixel(layer, [&](Pixel& p, int v, int u) {
    if (p.z == 0) return;
    const PaintAndCoverage& sum = paint(v, u);
    p.colour = cv::Vec3f(sum[0], sum[1], sum[2]) / sum[4];
    p.opacity = sum[3] / sum[4];
  });
}

/// Marks the skin behind the measured surface. A median removes single noisy pixels.
void mark_hidden(const RgbdFrame& frame, int scale, SkinLayer& layer) {
  cv::Mat_<std::uint8_t> hidden(layer.part.size());
  for_each_pixel(layer, [&](const Pixel& p, int v, int u) {
    const auto counts = frame.depth.at((layer.part.x + u) / scale, (layer.part.y + v) / scale);
    const float measured = static_cast<float>(counts * frame.depth_unit);
    hidden(v, u) = p.z > 0 && measured > 0 && p.z > measured + hidden_behind(p.z) ? 255 : 0;
  });
  cv::medianBlur(hidden, hidden, 5);
  for_each_pixel(layer, [&](Pixel& p, int v, int u) { p.hidden = hidden(v, u) > 0; });
}

/// Whether a pixel is on the outline of the skin: a neighbouring pixel has no skin, or skin that is clearly deeper.
bool on_outline(const SkinLayer& layer, int u, int v) {
  // Depth steps from which on there is an outline [m]: within a finger, and to another finger or hand.
  constexpr float kStep = 0.010f, kStepToOther = 0.003f;
  const Pixel& p = layer.pixels.at(u, v);
  const auto finger = [](const Pixel& q) { return q.segment == kPalm ? -1 : finger_of(q.segment); };
  for (const auto& [du, dv] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    if (!layer.pixels.contains(u + du, v + dv)) continue;
    const Pixel& q = layer.pixels.at(u + du, v + dv);
    const bool same = q.hand == p.hand && finger(q) == finger(p);
    if (q.z == 0 || q.z > p.z + (same ? kStep : kStepToOther)) return true;
  }
  return false;
}

}  // namespace

SkinLayer render_skin(const RgbdFrame& frame, int scale, std::span<const DrawnHand> hands) {
  SkinLayer layer;
  const Intrinsics camera = enlarged(frame.camera, scale);
  layer.pixels.reset(camera.width, camera.height);

  // Render each hand by itself, and keep the nearest skin.
  RenderedHand rendered;
  for (std::size_t k = 0; k < hands.size(); ++k) {
    if (!hands[k].estimate.has_pose()) continue;
    const CellGrid every_pixel{0, 0, 1, camera.width, camera.height};
    render_hand(hands[k].skin, pose_of(hands[k].estimate.segments), camera, every_pixel, rendered);
    add_hand(hands[k], static_cast<std::uint8_t>(k), rendered, layer);
  }

  if (layer.part.empty()) return layer;
  smooth_paint(scale, layer);
  mark_hidden(frame, scale, layer);
  return layer;
}

void paint_skin(const SkinLayer& layer, cv::Mat& picture) {
  constexpr int kStripe = 4;                                // width of the stripes of the hatching [px]
  constexpr float kHidden = 0.4f, kGap = 0.2f;              // factors on the opacity of hidden skin and between stripes
  constexpr float kOutline = 0.85f, kHiddenOutline = 0.5f;  // opacities of outlines
  constexpr float kOutlineLight = 0.7f, kHiddenOutlineLight = 1.2f;  // factors on the colour of outlines
  for (int v = layer.part.y; v < layer.part.br().y; ++v) {
    for (int u = layer.part.x; u < layer.part.br().x; ++u) {
      const Pixel& p = layer.pixels.at(u, v);
      if (p.z == 0) continue;

      // Choose the opacity and brightness: an outline is darker than the skin, but lighter if the skin is hidden.
      float opacity = p.hidden ? kHidden * p.opacity : p.opacity, light = 1;
      if (on_outline(layer, u, v)) {
        opacity = p.hidden ? kHiddenOutline : kOutline;
        light = p.hidden ? kHiddenOutlineLight : kOutlineLight;
      } else if (p.inferred && (u + v) / kStripe % 2 == 1) {
        opacity *= kGap;
      }

      // Blend the skin with the image below it.
      auto& pixel = picture.at<cv::Vec3b>(v, u);
      const cv::Vec3f below = pixel;
      pixel = below + opacity * (light * p.colour - below);
    }
  }
}

}  // namespace barehand
