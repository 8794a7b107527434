#include "stages/preprocess/coarse_grid.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "sensor/tint.h"

namespace barehand {
namespace {

// Samples a frame into the cells of a coarse grid.

constexpr int kCellsAcross = 160;  // columns of the grid; fingers at arm's length are still two cells wide
constexpr float kClearOdds = 2.f;  // the pixel of median depth decides for its cell if its log odds exceed this

constexpr int kSamples = 5;

/// Offsets [pixel] of the depth samples within one cell: the centre and four points near the corners.
struct Pattern {
  std::array<int, kSamples> du, dv;
  explicit Pattern(int step) {
    const int near_edge = step / 4, far_edge = step - 1 - near_edge;
    du = {step / 2, near_edge, far_edge, near_edge, far_edge};
    dv = {step / 2, near_edge, near_edge, far_edge, far_edge};
  }
};

/// The samples of one cell whose depth is in range, sorted by depth and, if that is equal, by position. A word holds
/// the depth in its upper bits and the sample's number in the lowest three. A sorting network is used, because noise
/// would make branches unpredictable.
class CellSamples {
 public:
  CellSamples(const RgbdFrame& frame, const Pattern& pattern, int u0, int v0, std::uint32_t lowest,
              std::uint32_t highest) {
    // Store the index of each sample in the lowest bits of its depth, so that both are sorted together; invalid samples
    // come last.
    for (std::uint32_t k = 0; k < kSamples; ++k) {
      const std::uint32_t d = frame.depth.at(u0 + pattern.du[k], v0 + pattern.dv[k]);
      const bool valid = (d >= lowest) & (d <= highest);
      words_[k] = valid ? d << 3 | k : ~0u;
      count_ += valid;
    }

    // Sort with a network of comparisons, which has no branches.
    const auto order = [this](int a, int b) {
      const auto [low, high] = std::minmax({words_[a], words_[b]});
      words_[a] = low;
      words_[b] = high;
    };
    order(0, 1), order(3, 4), order(2, 4), order(2, 3), order(1, 4), order(0, 3), order(0, 2), order(1, 3), order(1, 2);
  }
  int count() const { return count_; }
  std::uint32_t depth(int i) const { return words_[i] >> 3; }
  /// The sample's number in the pattern.
  int place(int i) const { return static_cast<int>(words_[i] & 7); }

 private:
  std::array<std::uint32_t, kSamples> words_;
  int count_ = 0;
};

}  // namespace

void sample_coarsely(const RgbdFrame& frame, const PreprocessParams& params, const SkinModel& skin, CoarseGrid& grid) {
  const Intrinsics& camera = frame.camera;

  // Choose the size of the cells, and the camera of the grid.
  grid.step = std::max(1, (camera.width + kCellsAcross / 2) / kCellsAcross);
  const double s = grid.step, centre = (s - 1) / 2;
  grid.camera = {camera.width / grid.step, camera.height / grid.step, camera.fx / s, camera.fy / s,
                 (camera.cx - centre) / s, (camera.cy - centre) / s};
  const int width = grid.camera.width, height = grid.camera.height;
  grid.z.reset(width, height);
  grid.colour.reset(width, height);
  grid.odds.reset(width, height);

  // Convert the limits of depth to the sensor's unit.
  const auto counts = [&](double metres) {
    return static_cast<std::uint16_t>(std::clamp(metres / frame.depth_unit, 1.0, 65535.0));
  };
  const std::uint16_t lowest = counts(params.min_depth), highest = counts(params.max_depth);
  const bool colour = params.use_colour && !frame.colour.empty();
  int seen = 0, tints = 0;
  const Pattern pattern(grid.step);

  // Sample the depth of each cell, and take the median.
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) {
      const int u0 = c * grid.step, v0 = r * grid.step;
      const CellSamples samples(frame, pattern, u0, v0, lowest, highest);
      const int count = samples.count(), median = (count - 1) / 2;
      if (count == 0) continue;
      grid.z.at(c, r) = static_cast<float>(samples.depth(median) * frame.depth_unit);
      if (!colour) continue;

      // Take the colour of the same sample.
      const auto colour_of = [&](int i) {
        const int k = samples.place(i);
        return frame.colour.at(u0 + pattern.du[k], v0 + pattern.dv[k]);
      };
      grid.colour.at(c, r) = colour_of(median);

      // Average the log odds over all samples if that colour does not decide.
      float odds = skin.log_odds(grid.colour.at(c, r));
      if (std::abs(odds) < kClearOdds) {
        float mean = 0;
        for (int k = 0; k < count; ++k) mean += skin.log_odds(colour_of(k));
        mean /= static_cast<float>(count);
        // Use the weaker of the two, since a colour border may cross the cell.
        odds = std::abs(mean) < std::abs(odds) ? mean : odds;
      }

      grid.odds.at(c, r) = odds;
      ++seen;
      tints += tinted(grid.colour.at(c, r));
    }
  grid.coloured = tints > kFewestTinted * seen;
}

}  // namespace barehand
