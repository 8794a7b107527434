// Warns if no depth of a camera lies in the range in which hands are searched for.
#include "app/shared/depth_range.h"

#include <algorithm>
#include <utility>

#include "core/format.h"

namespace barehand {
namespace {

constexpr int kPixelStep = 4;  // only every fourth pixel of every fourth row is used, which is enough
constexpr int kMostFrames = 30;
constexpr std::int64_t kLongest = 1'000'000;  // time that is checked at most [us]
constexpr double kNearest = 0.18;             // smallest plausible median depth [m]
constexpr double kFew = 1e-3;                 // a smaller fraction of depths within the limits counts as noise

}  // namespace

std::optional<std::string> DepthRange::add(const RgbdFrame& frame) {
  if (done_) return std::nullopt;
  if (frames_++ == 0) first_utime_ = frame.utime;
  unit_ = frame.depth_unit;

  // Collect the depth of a sparse grid of pixels, which suffices for a median.
  for (int v = 0; v < frame.depth.height(); v += kPixelStep) {
    for (int u = 0; u < frame.depth.width(); u += kPixelStep) {
      const std::uint16_t count = frame.depth.at(u, v);
      if (count == 0) continue;
      const double depth = unit_ * count;
      within_ += depth >= limits_.nearest && depth <= limits_.farthest;
      values_.push_back(count);
    }
  }

  // Judge as soon as enough frames were seen, or enough time has passed.
  if (frames_ < kMostFrames && frame.utime - first_utime_ < kLongest) return std::nullopt;
  return conclude();
}

std::optional<std::string> DepthRange::finish() {
  if (done_ || frames_ == 0) return std::nullopt;
  return conclude();
}

std::optional<std::string> DepthRange::conclude() {
  done_ = true;
  std::vector<std::uint16_t> values = std::exchange(values_, {});
  if (values.empty()) return "no pixel has depth: is the lens covered, or is everything out of range?";

  // Compare the depth with the limits: with a wrong unit, all of it is out of range.
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double median = unit_ * *middle;
  const bool nothing = static_cast<double>(within_) <= kFew * static_cast<double>(values.size());
  if (!nothing && median >= kNearest) return std::nullopt;

  // Describe what was measured, so that the user recognises a wrong unit.
  const std::string found = nothing ? formatted("nothing lies between %.3g and %.3g m, the median is %.3g m",
                                                limits_.nearest, limits_.farthest, median)
                                    : formatted("the median is %.3g m, nearer than depth cameras measure", median);
  return found + formatted(": is depth_units_per_metre (depth_unit of a message), now %.6g, right?", 1 / unit_);
}

}  // namespace barehand
