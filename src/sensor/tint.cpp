#include "sensor/tint.h"

namespace barehand {

bool has_colour(const RgbdFrame& frame) {
  constexpr int kStep = 8;
  const bool same_size = frame.colour.width() == frame.depth.width() && frame.colour.height() == frame.depth.height();
  if (frame.colour.empty() || !same_size) return false;

  int seen = 0, tints = 0;
  for (int v = 0; v < frame.depth.height(); v += kStep)
    for (int u = 0; u < frame.depth.width(); u += kStep) {
      if (frame.depth.at(u, v) == 0) continue;
      ++seen;
      tints += tinted(frame.colour.at(u, v));
    }
  return tints > kFewestTinted * seen;
}

}  // namespace barehand
