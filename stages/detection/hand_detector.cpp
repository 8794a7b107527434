#include "stages/detection/hand_detector.h"

#include <algorithm>
#include <cmath>

#include "stages/detection/heat_map.h"
#include "stages/detection/networks.h"
#include "stages/detection/weights.h"

namespace barehand {
namespace {

constexpr int kPalmRadius = 8;            // pixels around a peak: where the palm's depth is taken from
constexpr double kApart = 0.09;           // m between two hands' palms
constexpr double kRecentre = 0.03;        // m: a window that is off by more is looked at again
constexpr double kSmallestHand = 0.0012;  // m^2 facing the camera that a window shows of a hand

/// Median depth of what is labelled a hand near a peak [m]; 0: nothing is.
double palm_depth(const Image<float>& depth, const NetworkOutput& output, double u, double v) {
  std::vector<float> found;
  const int centre_u = static_cast<int>(std::lround(u)), centre_v = static_cast<int>(std::lround(v));
  for (int y = std::max(0, centre_v - kPalmRadius); y <= std::min(depth.height() - 1, centre_v + kPalmRadius); ++y)
    for (int x = std::max(0, centre_u - kPalmRadius); x <= std::min(depth.width() - 1, centre_u + kPalmRadius); ++x) {
      if (depth.at(x, y) <= 0) continue;
      const std::size_t cell = static_cast<std::size_t>(y / 2) * output.label_width + x / 2;
      const auto logit = [&](SurfaceLabel label) { return output.label_plane(static_cast<int>(label))[cell]; };
      const float hand = logit(SurfaceLabel::hand);
      if (hand >= logit(SurfaceLabel::background) && hand >= logit(SurfaceLabel::arm) &&
          hand >= logit(SurfaceLabel::object))
        found.push_back(depth.at(x, y));
    }
  if (found.empty()) return 0;
  const auto middle = found.begin() + found.size() / 2;
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

/// Area of the hand's pixels in a window [m^2], facing the camera.
double hand_area(const LabelMap& labels, const DepthView& view, const Image<float>& depth, const Intrinsics& camera) {
  double area = 0;
  for (int v = 0; v < depth.height(); ++v)
    for (int u = 0; u < depth.width(); ++u) {
      const double z = depth.at(u, v);
      if (z <= 0) continue;
      const Eigen::Vector2d pixel = view.frame_pixel(u, v);
      if (labels.covers(pixel.x(), pixel.y()) && labels.at(pixel.x(), pixel.y()) == SurfaceLabel::hand)
        area += z * z / (camera.fx * camera.fy) * view.step_u * view.step_v;
    }
  return area;
}

}  // namespace

HandDetector::HandDetector(Network full, Network crop, std::string version, const DetectionParams& params)
    : full_(std::move(full)), crop_(std::move(crop)), version_(std::move(version)), params_(params) {}

Result<HandDetector> HandDetector::load(const std::string& folder, const DetectionParams& params) {
  const auto weights = load_weights(folder);
  if (!weights) return tl::unexpected(weights.error());
  auto full = Network::load(weights->full, weights->full_path, kFullShape);
  if (!full) return tl::unexpected(full.error());
  auto crop = Network::load(weights->crop, weights->crop_path, kCropShape);
  if (!crop) return tl::unexpected(crop.error());
  return HandDetector(std::move(*full), std::move(*crop), weights->version, params);
}

void HandDetector::add_palms(const RgbdFrame& frame, const DepthView& view, const NetworkOutput& output) {
  for (const HeatPeak& peak :
       find_peaks({output.map_plane(0), output.map_width, output.map_height}, params_.least_palm)) {
    const double u = kMapStep * peak.column + kMapOffset, v = kMapStep * peak.row + kMapOffset;
    const double z = palm_depth(depth_, output, u, v);
    if (z <= 0) continue;
    const Eigen::Vector2d pixel = view.frame_pixel(u, v);
    palms_.push_back({frame.camera.unproject(pixel.x(), pixel.y(), z), peak.probability});
  }
}

Result<void> HandDetector::find_palms(const RgbdFrame& frame, Detection& out) {
  palms_.clear();
  for (const DepthView& view : frame_views(frame.camera)) {
    sample_depth(frame, view, depth_);
    fill_full(depth_, input_);
    const auto output = full_.run(input_);
    if (!output) return tl::unexpected(output.error());
    read_labels(*output, view, false, out.frame_labels.emplace_back());
    add_palms(frame, view, *output);
  }
  std::ranges::stable_sort(palms_, std::greater<>(), &Palm::probability);
  return {};
}

/// One window. `mirrored`: seen in a mirror, as a left hand looks like the right ones that the network knows.
Result<HandDetector::Window> HandDetector::look(const RgbdFrame& frame, const Eigen::Vector3d& centre, bool mirrored) {
  const DepthView view = window_around(centre, frame.camera);
  sample_depth(frame, view, depth_);
  fill_crop(depth_, centre.z(), mirrored, input_);
  const auto output = crop_.run(input_);
  if (!output) return tl::unexpected(output.error());

  Window window;
  DetectedHand& hand = window.hand;
  for (int k = 0; k < kLandmarkCount; ++k)
    hand.joints[k] = read_joint(*output, k, view, centre.z(), mirrored, frame.camera);
  hand.centre = 0.5 * (hand.joints[kWristLandmark].position + hand.joints[kMiddleKnuckleLandmark].position);
  hand.right_log_odds = mirrored ? -output->side : output->side;
  read_labels(*output, view, mirrored, hand.labels);
  window.hand_area = hand_area(hand.labels, view, depth_, frame.camera);
  return window;
}

/// Looks at a place until the hand is in the middle of the window and of the side that the window is made for.
Result<std::optional<DetectedHand>> HandDetector::examine(const RgbdFrame& frame, const Expected& place) {
  bool mirrored = place.side == Handedness::left;
  auto window = look(frame, place.centre, mirrored);
  if (!window) return tl::unexpected(window.error());
  const auto other_side = [&] { return !place.side && (window->hand.side() == Handedness::left) != mirrored; };
  const bool aside = (window->hand.centre - place.centre).norm() > kRecentre;
  if (aside || other_side()) {
    if (window->hand.centre.z() <= 0) return std::nullopt;
    mirrored = mirrored != other_side();
    window = look(frame, window->hand.centre, mirrored);
    if (!window) return tl::unexpected(window.error());
  }

  // Both windows say the other one: the average decides, and its joints count.
  if (other_side() && window->hand.centre.z() > 0) {
    auto other = look(frame, window->hand.centre, !mirrored);
    if (!other) return tl::unexpected(other.error());
    const double right = 0.5 * (window->hand.right_log_odds + other->hand.right_log_odds);
    if ((right < 0) != mirrored) *window = std::move(*other);
    window->hand.right_log_odds = right;
  }
  if (window->hand_area < kSmallestHand) return std::nullopt;
  return std::move(window->hand);
}

Result<void> HandDetector::add(const RgbdFrame& frame, const Expected& place, double palm, Detection& out) {
  auto hand = examine(frame, place);
  if (!hand) return tl::unexpected(hand.error());
  if (!*hand) return {};
  const auto same = [&](const DetectedHand& other) { return (other.centre - (*hand)->centre).norm() < kApart; };
  if (std::ranges::any_of(out.hands, same)) return {};
  (*hand)->palm = palm;
  out.hands.push_back(std::move(**hand));
  return {};
}

Result<Detection> HandDetector::detect(const RgbdFrame& frame) {
  Detection out;
  out.whole_frame = true;
  if (const auto found = find_palms(frame, out); !found) return tl::unexpected(found.error());
  for (const Palm& palm : palms_) {
    if (out.hands.size() == kMostHands) break;
    const auto same = [&](const DetectedHand& hand) { return (hand.centre - palm.centre).norm() < kApart; };
    if (std::ranges::any_of(out.hands, same)) continue;
    if (const auto added = add(frame, {palm.centre, {}}, palm.probability, out); !added)
      return tl::unexpected(added.error());
  }
  return out;
}

Result<Detection> HandDetector::detect_at(const RgbdFrame& frame, std::span<const Expected> places) {
  Detection out;
  for (const Expected& place : places)
    if (const auto added = add(frame, place, 1, out); !added) return tl::unexpected(added.error());
  return out;
}

}  // namespace barehand
