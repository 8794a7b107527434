#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace barehand {

/// Counter-based random numbers (Philox 4x32-10, Salmon et al., SC 2011). A value depends on key and counter only, so
/// results depend neither on the number of threads nor on the order of draws.
class Philox {
 public:
  /// `seed` is the seed of the run; the words of the counter identify the draw: frame, segment, level, sample.
  static std::array<std::uint32_t, 4> block(std::uint64_t seed, std::array<std::uint32_t, 4> counter) {
    std::uint32_t k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32);
    for (int round = 0; round < 10; ++round) {
      const std::uint64_t p0 = std::uint64_t{0xD2511F53u} * counter[0];
      const std::uint64_t p1 = std::uint64_t{0xCD9E8D57u} * counter[2];
      counter = {static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ k0, static_cast<std::uint32_t>(p1),
                 static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ k1, static_cast<std::uint32_t>(p0)};
      k0 += 0x9E3779B9u;
      k1 += 0xBB67AE85u;
    }
    return counter;
  }
  /// Maps 32 random bits to [0, 1).
  static double uniform(std::uint32_t bits) { return bits * (1.0 / 4294967296.0); }
};

/// A stream of random numbers for one purpose, which the key words a, b and c identify. It is cheap to construct.
class KeyedRandom {
 public:
  KeyedRandom(std::uint64_t seed, std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0)
      : seed_(seed), counter_{0, a, b, c} {}
  std::uint32_t bits() {
    if (used_ == 4) {
      block_ = Philox::block(seed_, counter_);
      ++counter_[0];
      used_ = 0;
    }
    return block_[used_++];
  }
  double uniform() { return Philox::uniform(bits()); }
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  double normal() {  // Box-Muller; (bits + 1) keeps the logarithm finite
    const double u = (bits() + 1.0) / 4294967296.0;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t seed_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
};

}  // namespace barehand
