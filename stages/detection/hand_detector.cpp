// Detects hands in a depth image with the networks.
#include "stages/detection/hand_detector.h"

#include <algorithm>
#include <cmath>

#include "stages/detection/heat_map.h"
#include "stages/detection/networks.h"
#include "stages/detection/weights.h"

namespace barehand {
namespace {

constexpr int kPalmRadius = 8;            // half the size of the square around a peak that gives the palm's depth [px]
constexpr double kApart = 0.09;           // minimum distance between two hands' palms [m]
constexpr double kRecentre = 0.03;        // if the palm is off the window's centre by more, the window is moved [m]
constexpr double kSmallestHand = 0.0012;  // minimum area of a hand in its window, facing the camera [m^2]

/// Median depth [m] of the pixels near a peak that are labelled as hand; 0 if there are none.
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

/// Area of the pixels in a window that are labelled as hand, projected onto a plane facing the camera [m^2].
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
  auto full = Network::load(weights->full.bytes, weights->full.path, kFullShape);
  if (!full) return tl::unexpected(full.error());
  auto crop = Network::load(weights->crop.bytes, weights->crop.path, kCropShape);
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

/// Runs the second network on the window around `centre`. `mirrored`: the window is mirrored, which turns a left hand
/// into a right one; the network was trained with right hands.
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

/// Runs the second network at a place, and once more if the hand is off the window's centre or of the other side than
/// the window was mirrored for.
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

  // If the window still shows the other side, try the other mirroring, too. The average of the log odds decides the
  // side, and the window of that side gives the joints.
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
