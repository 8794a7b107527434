#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "sensor/rgbd_frame.h"

namespace barehand {

/// Tells skin from everything else by colour. Chroma is (log R/G, log B/G): brightness cancels and a change of white
/// balance is a mere shift. A generic density of human skin is blended with histograms of this person, light and
/// surrounding; both classes forget at the same rate. What is much darker than this skin in this light is something
/// else: dark wood has the chroma of skin. Deterministic: depends only on the order of learn() calls.
class SkinModel {
 public:
  /// `rate`: share of one learn() in the histograms; `share`: weight of a fully learned histogram against the prior.
  SkinModel(double rate, double share);

  /// log p(colour | skin) - log p(colour | other), damped for dark and overexposed pixels; 0 = no evidence.
  float log_odds(Rgb c) const {
    const int brightest = brightest_of(c);
    const int darkest = c.r < c.g ? (c.r < c.b ? c.r : c.b) : (c.g < c.b ? c.g : c.b);
    if (darkest >= kOverexposed) return 0.f;
    return std::max(-kOddsLimit, trust_[brightest] * odds_[bin(c)] + too_dark_[brightest]);
  }

  /// Adapts to pixels known to be skin and pixels known not to be. Too few of a kind leave that kind as it is.
  void learn(const std::vector<Rgb>& skin, const std::vector<Rgb>& other);

 private:
  static constexpr int kBins = 40;           // per axis
  static constexpr double kBinWidth = 0.05;  // in log chroma
  static constexpr int kOverexposed = 250;
  static constexpr float kOddsLimit = 4.f;  // no single pixel may outvote its whole neighbourhood
  using Histogram = std::array<float, kBins * kBins>;

  static constexpr int kFraction = 64;        // fixed-point steps per bin
  static constexpr double kRedStart = -0.6;   // log R/G of the first bin's lower edge
  static constexpr double kBlueStart = -1.5;  // log B/G
  static int brightest_of(Rgb c) { return c.r > c.g ? (c.r > c.b ? c.r : c.b) : (c.g > c.b ? c.g : c.b); }
  int bin(Rgb c) const {
    constexpr int kRedOffset = static_cast<int>(-kRedStart / kBinWidth * kFraction + 0.5);
    constexpr int kBlueOffset = static_cast<int>(-kBlueStart / kBinWidth * kFraction + 0.5);
    const int red = (log_[c.r] - log_[c.g] + kRedOffset) / kFraction;
    const int blue = (log_[c.b] - log_[c.g] + kBlueOffset) / kFraction;
    return std::clamp(blue, 0, kBins - 1) * kBins + std::clamp(red, 0, kBins - 1);
  }
  /// False: too few colours.
  static bool add(Histogram& learned, double& mass, const std::vector<Rgb>& colours, double rate,
                  const SkinModel& model);
  void learn_brightness(const std::vector<Rgb>& skin);
  void rebuild();

  double rate_, share_;
  std::array<int, 256> log_{};      // fixed-point log of a channel
  std::array<float, 256> trust_{};  // by the brightest channel: chroma of dark pixels is noise
  Histogram prior_skin_{}, prior_other_{}, skin_{}, other_{}, odds_{};
  double skin_mass_ = 0, other_mass_ = 0;      // [0, 1): how much has been learned
  double brightness_ = 0, brightness_sq_ = 0;  // moments of the log of skin's brightest channel, times skin_mass_
  std::array<float, 256> too_dark_{};          // log odds by the brightest channel, 0 or less; black is no colour
};

}  // namespace barehand
