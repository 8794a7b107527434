#include "observe/skin_model.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

// Learns histograms of skin and other colours, and computes the log odds of skin from them.

constexpr std::size_t kFewestColours = 30;  // fewer pixels do not determine a distribution
constexpr double kLeastSpread = 0.35;  // smallest assumed deviation of skin's log brightness, since skin may get shaded
constexpr double kUsualSpread = 2;  // brightness down to this many standard deviations below the mean is not evidence

/// Generic density of skin over (log R/G, log B/G), from pale to dark skin in white to warm light, with the red of
/// fingertips and of shaded folds.
double skin_density(double red, double blue) {
  constexpr double kRed = 0.15, kBlue = 0.17;
  const double r = (red - 0.36) / kRed, b = (blue + 0.20) / kBlue;
  return std::exp(-0.5 * (r * r + b * b)) / (2 * M_PI * kRed * kBlue);
}

/// Generic density of all other colours, which scatter around grey.
double other_density(double red, double blue) {
  constexpr double kRed = 0.35, kBlue = 0.45, kUniform = 0.05;
  return std::exp(-0.5 * (red * red / (kRed * kRed) + blue * blue / (kBlue * kBlue))) / (2 * M_PI * kRed * kBlue) +
         kUniform;
}

}  // namespace

SkinModel::SkinModel(double rate, double share) : rate_(rate), share_(share) {
  for (int i = 0; i < 256; ++i) {
    log_[i] = static_cast<int>(std::lround(std::log(std::max(i, 1)) / kBinWidth * kFraction));
    trust_[i] = i == 0 ? 0.f : std::clamp((i - 12) / 36.f, 0.05f, 1.f);
  }
  for (int b = 0; b < kBins; ++b)
    for (int r = 0; r < kBins; ++r) {
      const double red = kRedStart + (r + 0.5) * kBinWidth, blue = kBlueStart + (b + 0.5) * kBinWidth;
      prior_skin_[b * kBins + r] = static_cast<float>(skin_density(red, blue) * kBinWidth * kBinWidth);
      prior_other_[b * kBins + r] = static_cast<float>(other_density(red, blue) * kBinWidth * kBinWidth);
    }
  rebuild();
}

bool SkinModel::add(Histogram& learned, double& mass, const std::vector<Rgb>& colours, double rate,
                    const SkinModel& model) {
  // Count the colours; those that are overexposed say nothing.
  Histogram fresh{};
  double total = 0;
  for (const Rgb& c : colours) {
    const float weight = model.trust_[brightest_of(c)];
    if (std::min({c.r, c.g, c.b}) >= kOverexposed) continue;
    fresh[model.bin(c)] += weight;
    total += weight;
  }

  // Blend them into what was learned before.
  if (total < kFewestColours) return false;
  const float scale = static_cast<float>(rate / total);
  for (std::size_t i = 0; i < learned.size(); ++i)
    learned[i] = static_cast<float>(1 - rate) * learned[i] + scale * fresh[i];
  mass = (1 - rate) * mass + rate;
  return true;
}

void SkinModel::learn(const std::vector<Rgb>& skin, const std::vector<Rgb>& other) {
  if (rate_ <= 0) return;
  if (add(skin_, skin_mass_, skin, rate_, *this)) learn_brightness(skin);
  add(other_, other_mass_, other, rate_, *this);
  rebuild();
}

void SkinModel::learn_brightness(const std::vector<Rgb>& skin) {
  // Compute the moments of the logarithm of brightness.
  double sum = 0, sum_sq = 0;
  for (const Rgb& c : skin) {
    const double x = std::log(std::max(brightest_of(c), 1));
    sum += x;
    sum_sq += x * x;
  }

  // Blend them into what was learned before.
  const double count = static_cast<double>(skin.size());
  brightness_ += rate_ * (sum / count - brightness_);
  brightness_sq_ += rate_ * (sum_sq / count - brightness_sq_);

  // Tabulate how much a pixel is too dark to be skin.
  const double mean = brightness_ / skin_mass_, variance = brightness_sq_ / skin_mass_ - mean * mean;
  const double spread = std::max(kLeastSpread, std::sqrt(std::max(0.0, variance)));
  for (int i = 1; i < 256; ++i) {
    const double below = std::max(0.0, (mean - std::log(i)) / spread);
    const double odds = -0.5 * std::max(0.0, below * below - kUsualSpread * kUsualSpread);
    too_dark_[i] = static_cast<float>(skin_mass_ * std::max(odds, -2.0 * kOddsLimit));  // can outweigh all chroma odds
  }
}

void SkinModel::rebuild() {
  // Blur the histograms (3x3 binomial), since an observed colour makes similar colours likely, too.
  const auto blurred = [](const Histogram& h, int b, int r) {
    static constexpr float kWeight[3] = {0.25f, 0.5f, 0.25f};
    float sum = 0;
    for (int db = -1; db <= 1; ++db)
      for (int dr = -1; dr <= 1; ++dr)
        sum += kWeight[db + 1] * kWeight[dr + 1] *
               h[std::clamp(b + db, 0, kBins - 1) * kBins + std::clamp(r + dr, 0, kBins - 1)];
    return sum;
  };

  // Blend the learned histograms with the generic densities.
  const float skin_prior = static_cast<float>(1 - share_ * skin_mass_);
  const float other_prior = static_cast<float>(1 - share_ * other_mass_);
  const float share = static_cast<float>(share_);

  // Compute the log odds of each bin.
  for (int b = 0; b < kBins; ++b)
    for (int r = 0; r < kBins; ++r) {
      const int i = b * kBins + r;
      const float skin = skin_prior * prior_skin_[i] + share * blurred(skin_, b, r);
      const float other = other_prior * prior_other_[i] + share * blurred(other_, b, r);
      odds_[i] = std::clamp(std::log((skin + 1e-6f) / (other + 1e-6f)), -kOddsLimit, kOddsLimit);
    }
}

}  // namespace barehand
