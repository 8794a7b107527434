#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "sensor/rgbd_frame.h"

namespace barehand {

/// Distinguishes skin from everything else by colour. Chroma is (log R/G, log B/G), so that brightness cancels and a
/// change of white balance is only a shift. Generic densities are blended with histograms of this person, light and
/// surroundings; the histograms of both classes forget at the same rate. A pixel that is much darker than the learned
/// skin counts as something else, because dark wood, for example, has the chroma of skin. Deterministic: depends only
/// on the learn() calls and their order.
class SkinModel {
 public:
  /// `rate`: weight of one learn() in the histograms; `share`: weight of a fully learned histogram, in [0, 1]; the
  /// generic density has the rest.
  SkinModel(double rate, double share);

  /// log p(colour | skin) - log p(colour | other), damped for dark and overexposed pixels; 0 = no evidence.
  float log_odds(Rgb c) const {
    const int brightest = brightest_of(c);
    const int darkest = c.r < c.g ? (c.r < c.b ? c.r : c.b) : (c.g < c.b ? c.g : c.b);
    if (darkest >= kOverexposed) return 0.f;
    return std::max(-kOddsLimit, trust_[brightest] * odds_[bin(c)] + too_dark_[brightest]);
  }

  /// Adapts to pixels known to be skin and pixels known not to be. A class with too few pixels is not changed.
  void learn(const std::vector<Rgb>& skin, const std::vector<Rgb>& other);

 private:
  static constexpr int kBins = 40;           // bins per axis
  static constexpr double kBinWidth = 0.05;  // width of a bin in log chroma
  static constexpr int kOverexposed = 250;   // darkest channel of an overexposed pixel
  static constexpr float kOddsLimit = 4.f;   // limit of one pixel's odds, so that it cannot outvote its neighbourhood
  using Histogram = std::array<float, kBins * kBins>;

  static constexpr int kFraction = 64;        // fixed-point steps per bin
  static constexpr double kRedStart = -0.6;   // log R/G of the first bin's lower edge
  static constexpr double kBlueStart = -1.5;  // log B/G of the first bin's lower edge
  static int brightest_of(Rgb c) { return c.r > c.g ? (c.r > c.b ? c.r : c.b) : (c.g > c.b ? c.g : c.b); }
  int bin(Rgb c) const {
    constexpr int kRedOffset = static_cast<int>(-kRedStart / kBinWidth * kFraction + 0.5);
    constexpr int kBlueOffset = static_cast<int>(-kBlueStart / kBinWidth * kFraction + 0.5);
    const int red = (log_[c.r] - log_[c.g] + kRedOffset) / kFraction;
    const int blue = (log_[c.b] - log_[c.g] + kBlueOffset) / kFraction;
    return std::clamp(blue, 0, kBins - 1) * kBins + std::clamp(red, 0, kBins - 1);
  }
  /// Adds colours to the histogram `learned`. Returns false if they are too few.
  static bool add(Histogram& learned, double& mass, const std::vector<Rgb>& colours, double rate,
                  const SkinModel& model);
  void learn_brightness(const std::vector<Rgb>& skin);
  void rebuild();

  double rate_, share_;
  std::array<int, 256> log_{};      // logarithm of a channel's value, in fixed point
  std::array<float, 256> trust_{};  // weight of the chroma by the brightest channel: in the dark, chroma is noise
  Histogram prior_skin_{}, prior_other_{}, skin_{}, other_{}, odds_{};
  double skin_mass_ = 0, other_mass_ = 0;      // how much of each class has been learned, in [0, 1)
  double brightness_ = 0, brightness_sq_ = 0;  // moments of the log of skin's brightest channel, times skin_mass_
  // Log odds (0 or less) that a pixel is too dark to be skin, by its brightest channel; black means no colour.
  std::array<float, 256> too_dark_{};
};

}  // namespace barehand
