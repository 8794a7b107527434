// Pairs the depth images of a recording with its colour images.
#include "io/recording/colour_pairs.h"

#include <algorithm>
#include <map>

#include "sensor/frame_order.h"

namespace barehand {
namespace {

using Times = std::span<const std::int64_t>;

/// A colour image: its time stamp and its index in the list.
struct Stamped {
  std::int64_t utime = 0;
  std::size_t index = 0;
};

/// The typical (median) time between two frames [us].
std::int64_t frame_interval(Times depth) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < depth.size(); ++i) steps.push_back(depth[i] - depth[i - 1]);
  if (steps.empty()) return 50'000;
  std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());
  return std::max<std::int64_t>(steps[steps.size() / 2], 1);
}

/// Index of the image nearest in time; none if its time differs by more than `window`, because the hand then had
/// another pose.
std::optional<std::size_t> nearest(const std::vector<Stamped>& sorted, std::int64_t utime, std::int64_t window) {
  const auto after = std::lower_bound(sorted.begin(), sorted.end(), utime,
                                      [](const Stamped& image, std::int64_t t) { return image.utime < t; });
  auto best = after;
  if (after == sorted.end() || (after != sorted.begin() && utime - std::prev(after)->utime <= after->utime - utime))
    best = after == sorted.begin() ? after : std::prev(after);
  if (best == sorted.end() || std::abs(best->utime - utime) > window) return std::nullopt;
  return best->index;
}

/// For each time stamp, the part of the recording that it belongs to, from 0: a part ends where the recorder was
/// restarted.
std::vector<int> parts_of(Times times) {
  std::vector<int> parts(times.size(), 0);
  for (std::size_t i = 1; i < times.size(); ++i)
    parts[i] = parts[i - 1] + (times[i - 1] - times[i] >= kRestart ? 1 : 0);
  return parts;
}

}  // namespace

ColourPairs pair_colour(Times depth, Times colour) {
  ColourPairs pairs{{}, frame_interval(depth)};
  const std::vector<int> depth_parts = parts_of(depth), colour_parts = parts_of(colour);

  // If both lists have the same number of parts, search the colour images of the corresponding part only.
  const bool agree = !depth.empty() && !colour.empty() && depth_parts.back() == colour_parts.back();
  std::map<int, std::vector<Stamped>> by_part;
  for (std::size_t i = 0; i < colour.size(); ++i) by_part[agree ? colour_parts[i] : 0].push_back({colour[i], i});
  for (auto& [part, images] : by_part)
    std::stable_sort(images.begin(), images.end(),
                     [](const Stamped& a, const Stamped& b) { return a.utime < b.utime; });

  // Find the colour of each depth image. If the numbers of parts differ, use a colour image only in the first part in
  // which it is the nearest.
  std::map<std::size_t, int> first_part;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    auto found = nearest(by_part[agree ? depth_parts[i] : 0], depth[i], pairs.window);
    if (found && !agree && first_part.try_emplace(*found, depth_parts[i]).first->second != depth_parts[i])
      found.reset();
    pairs.colour.push_back(found);
  }
  return pairs;
}

}  // namespace barehand
