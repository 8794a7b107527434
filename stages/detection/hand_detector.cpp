// Detects hands in a depth image with the networks.
#include "stages/detection/hand_detector.h"

#include <algorithm>
#include <cmath>

#include "stages/detection/heat_map.h"
#include "stages/detection/networks.h"
#include "stages/detection/weights.h"

namespace barehand {
namespace {

constexpr int kPalmRadius = 8;   // half the side of the square around a peak in which the palm's depth is measured [px]
constexpr double kApart = 0.09;  // minimum distance between two hands' palms [m]
constexpr double kSameHand = 0.05;  // the same for tracked hands, which are known to be two [m]

/// Median depth [m] of the pixels near a peak of the palm heat map that the network labels as hand; 0 if there are
/// none. (u, v): pixel of `depth` at the peak.
double palm_depth(const Image<float>& depth, const NetworkOutput& output, double u, double v) {
  std::vector<float> found;

  // Collect the depths of the pixels around the peak that the network labels as hand.
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

  // Take the median.
  if (found.empty()) return 0;
  const auto middle = found.begin() + found.size() / 2;
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

}  // namespace

HandDetector::HandDetector(Network full, std::vector<WindowExaminer> examiners, std::string version,
                           const DetectionParams& params)
    : full_(std::move(full)), examiners_(std::move(examiners)), version_(std::move(version)), params_(params) {}

Result<HandDetector> HandDetector::load(const std::string& folder, const DetectionParams& params) {
  const auto weights = load_weights(folder);
  if (!weights) return tl::unexpected(weights.error());
  auto full = Network::load(weights->full.bytes, weights->full.path, kFullShape);
  if (!full) return tl::unexpected(full.error());
  std::vector<WindowExaminer> examiners;
  for (int i = 0; i < kAtOnce + 1; ++i) {
    auto crop = Network::load(weights->crop.bytes, weights->crop.path, kCropShape);
    if (!crop) return tl::unexpected(crop.error());
    examiners.emplace_back(std::move(*crop));
  }
  return HandDetector(std::move(*full), std::move(examiners), weights->version, params);
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

Result<void> HandDetector::find_palms(const RgbdFrame& frame, const SkinModel* skin, Workers& workers) {
  palms_.clear();
  for (const DepthView& view : frame_views(frame.camera)) {
    sample_depth(frame, view, depth_);
    if (skin) keep_skin(frame, view, *skin, depth_);
    fill_full(depth_, input_);
    const auto output = full_.run(input_, workers);
    if (!output) return tl::unexpected(output.error());
    add_palms(frame, view, *output);
  }
  std::ranges::stable_sort(palms_, std::greater<>(), &Palm::probability);
  return {};
}

bool HandDetector::is_new(const Eigen::Vector3d& centre, const Detection& out, double apart) {
  return std::ranges::none_of(out.hands, [&](const auto& hand) { return (hand.centre - centre).norm() < apart; });
}

Result<void> HandDetector::examine(const RgbdFrame& frame, std::span<const ExpectedHand> places, Workers& workers) {
  workers.for_each_index(static_cast<int>(places.size()),
                         [&](int i) { found_[i] = examiners_[i].examine(frame, places[i], workers); });
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!found_[i]) return tl::unexpected(found_[i].error());
  return {};
}

void HandDetector::add(std::optional<DetectedHand> hand, double palm, double apart, Detection& out) {
  if (!hand || !is_new(hand->centre, out, apart)) return;
  hand->palm = palm;
  out.hands.push_back(std::move(*hand));
}

void HandDetector::choose_palms(const Detection& out) {
  chosen_.clear();
  for (; next_ < palms_.size() && chosen_.size() < kAtOnce; ++next_) {
    const Palm& palm = palms_[next_];
    const auto near = [&](const Palm& other) { return (other.centre - palm.centre).norm() < 2 * kApart; };
    if (!is_new(palm.centre, out, kApart)) continue;
    if (std::ranges::any_of(chosen_, near)) return;
    chosen_.push_back(palm);
  }
}

Result<Detection> HandDetector::detect(const RgbdFrame& frame, Workers& workers, std::span<const ExpectedHand> tracked,
                                       std::optional<Handedness> wanted, const SkinModel* skin) {
  Detection out;
  out.whole_frame = true;
  if (const auto found = find_palms(frame, skin, workers); !found) return tl::unexpected(found.error());

  // Leave out palms that earlier searches found to be unlikely, except near a tracked hand.
  PalmHistory& known = known_[skin ? 1 : 0];
  known.begin_search();
  std::erase_if(palms_, [&](const Palm& palm) {
    const auto here = [&](const ExpectedHand& hand) { return (hand.centre - palm.centre).norm() < kApart; };
    return std::ranges::none_of(tracked, here) && known.may_skip(palm.centre, palm.probability);
  });

  for (next_ = 0; next_ < palms_.size() && out.hands.size() < kMostHands;) {
    // Examine the next palms in one batch.
    choose_palms(out);
    places_.clear();
    for (const Palm& palm : chosen_) places_.push_back({palm.centre, {}, wanted, skin});
    if (const auto done = examine(frame, places_, workers); !done) return tl::unexpected(done.error());

    // Add the hands that were found.
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      auto& hand = *found_[i];
      known.examined(chosen_[i].centre, chosen_[i].probability, hand ? &*hand : nullptr);
      if (out.hands.size() < kMostHands) add(std::move(hand), chosen_[i].probability, kApart, out);
    }
  }
  return out;
}

Result<Detection> HandDetector::detect_at(const RgbdFrame& frame, std::span<const ExpectedHand> tracked,
                                          Workers& workers, Detection found) {
  places_.clear();
  for (const ExpectedHand& hand : tracked)
    if (is_new(hand.centre, found, kSameHand)) places_.push_back(hand);

  for (std::span<const ExpectedHand> places = places_; !places.empty();) {
    const auto some = places.first(std::min<std::size_t>(kAtOnce, places.size()));
    places = places.subspan(some.size());
    if (const auto done = examine(frame, some, workers); !done) return tl::unexpected(done.error());
    for (std::size_t i = 0; i < some.size(); ++i) add(std::move(*found_[i]), 1, kSameHand, found);
  }
  found.around_tracked = true;
  return found;
}

}  // namespace barehand
