#include "sensor/picture_check.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace barehand {
namespace {

// Detects depth images without usable content.

// A depth image with a larger fraction of jumps between neighbours (see jump_fraction()) is noise.
constexpr double kSenseless = 0.4;
constexpr int kRowStep = 4;       // only every fourth row is tested, which is enough
constexpr int kFewestPairs = 64;  // with fewer pairs of measured neighbours, an image is not tested for noise

bool same(const Image<std::uint16_t>& a, const Image<std::uint16_t>& b) {
  return a.width() == b.width() && a.height() == b.height() && std::memcmp(a.data(), b.data(), 2 * a.size()) == 0;
}

}  // namespace

double jump_fraction(const Image<std::uint16_t>& depth) {
  std::int64_t pairs = 0, jumps = 0;
  for (int v = 0; v < depth.height(); v += kRowStep) {
    const std::uint16_t* row = depth.row(v);
    for (int u = 0; u + 1 < depth.width(); ++u) {
      const int a = row[u], b = row[u + 1];
      const bool measured = (a != 0) & (b != 0);
      pairs += measured;
      jumps += measured & (5 * std::abs(a - b) > std::max(a, b));
    }
  }
  return pairs < kFewestPairs ? 0 : static_cast<double>(jumps) / static_cast<double>(pairs);
}

DepthFault check_depth(const Image<std::uint16_t>& depth, const Image<std::uint16_t>* before) {
  const bool measured = std::any_of(depth.data(), depth.data() + depth.size(), [](std::uint16_t d) { return d != 0; });
  if (!measured) return DepthFault::empty;
  if (before && same(depth, *before)) return DepthFault::repeated;
  return jump_fraction(depth) > kSenseless ? DepthFault::senseless : DepthFault::none;
}

}  // namespace barehand
