#include "stages/preprocess/coarse_grid.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace barehand {
namespace {

constexpr int kCellsAcross = 160;  // fingers at arm's length are still two cells wide
constexpr int kGreyTolerance = 6;  // channels of a grey image differ by less (compression)
constexpr float kClearOdds = 2.f;  // of one pixel: the rest of its cell need not be asked
constexpr double kFewestTinted = 0.01;

struct Sample {
  std::uint16_t depth;
  int u, v;
};

/// Samples of one cell with a measurement in range, sorted by depth; ties by position.
int cell_samples(const RgbdFrame& frame, int u0, int v0, int step, std::uint16_t lowest, std::uint16_t highest,
                 std::array<Sample, 5>& samples) {
  const int near_edge = step / 4, far_edge = step - 1 - near_edge;
  const int du[5] = {step / 2, near_edge, far_edge, near_edge, far_edge};
  const int dv[5] = {step / 2, near_edge, near_edge, far_edge, far_edge};
  int count = 0;
  for (int k = 0; k < 5; ++k) {
    const std::uint16_t d = frame.depth.at(u0 + du[k], v0 + dv[k]);
    if (d < lowest || d > highest) continue;
    int i = count++;
    for (; i > 0 && samples[i - 1].depth > d; --i) samples[i] = samples[i - 1];
    samples[i] = {d, u0 + du[k], v0 + dv[k]};
  }
  return count;
}

bool tinted(Rgb c) { return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) > kGreyTolerance; }

}  // namespace

void sample_coarsely(const RgbdFrame& frame, const PreprocessParams& params, const SkinModel& skin, CoarseGrid& grid) {
  const Intrinsics& camera = frame.camera;
  grid.step = std::max(1, (camera.width + kCellsAcross / 2) / kCellsAcross);
  const double s = grid.step, centre = (s - 1) / 2;
  grid.camera = {camera.width / grid.step, camera.height / grid.step, camera.fx / s, camera.fy / s,
                 (camera.cx - centre) / s, (camera.cy - centre) / s};
  const int width = grid.camera.width, height = grid.camera.height;
  grid.z.reset(width, height);
  grid.colour.reset(width, height);
  grid.odds.reset(width, height);
  const auto counts = [&](double metres) {
    return static_cast<std::uint16_t>(std::clamp(metres / frame.depth_unit, 1.0, 65535.0));
  };
  const std::uint16_t lowest = counts(params.min_depth), highest = counts(params.max_depth);
  const bool colour = params.use_colour && !frame.colour.empty();
  int seen = 0, tints = 0;
  std::array<Sample, 5> samples;
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) {
      const int count = cell_samples(frame, c * grid.step, r * grid.step, grid.step, lowest, highest, samples);
      if (count == 0) continue;
      const Sample& median = samples[(count - 1) / 2];
      grid.z.at(c, r) = static_cast<float>(median.depth * frame.depth_unit);
      if (!colour) continue;
      grid.colour.at(c, r) = frame.colour.at(median.u, median.v);
      float odds = skin.log_odds(grid.colour.at(c, r));
      if (std::abs(odds) < kClearOdds) {
        float mean = 0;
        for (int k = 0; k < count; ++k) mean += skin.log_odds(frame.colour.at(samples[k].u, samples[k].v));
        mean /= static_cast<float>(count);
        odds = std::abs(mean) < std::abs(odds) ? mean : odds;  // a border through the cell must not sway it
      }
      grid.odds.at(c, r) = odds;
      ++seen;
      tints += tinted(grid.colour.at(c, r));
    }
  grid.coloured = tints > kFewestTinted * seen;
}

}  // namespace barehand
