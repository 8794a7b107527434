#include "io/recording/colour_pairs.h"

#include <algorithm>
#include <map>
#include <span>

#include "sensor/frame_order.h"

namespace barehand {
namespace {

/// The typical time between two frames [us].
std::int64_t frame_interval(const std::vector<StampedFile>& depth) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < depth.size(); ++i) steps.push_back(depth[i].utime - depth[i - 1].utime);
  if (steps.empty()) return 50'000;
  std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());
  return std::max<std::int64_t>(steps[steps.size() / 2], 1);
}

/// The file nearest in time, or "" if none lies within one frame interval: older colour belongs to another pose.
std::string nearest_file(const std::vector<StampedFile>& sorted, std::int64_t utime, std::int64_t window) {
  const auto after = std::lower_bound(sorted.begin(), sorted.end(), utime,
                                      [](const StampedFile& file, std::int64_t t) { return file.utime < t; });
  auto best = after;
  if (after == sorted.end() || (after != sorted.begin() && utime - std::prev(after)->utime <= after->utime - utime))
    best = after == sorted.begin() ? after : std::prev(after);
  if (best == sorted.end() || std::abs(best->utime - utime) > window) return {};
  return best->file;
}

/// The part of the recording that each file of a list belongs to, from 0.
std::vector<int> parts_of(const std::vector<StampedFile>& files) {
  std::vector<int> parts(files.size(), 0);
  for (std::size_t i = 1; i < files.size(); ++i)
    parts[i] = parts[i - 1] + (files[i - 1].utime - files[i].utime >= kRestart ? 1 : 0);
  return parts;
}

std::vector<StampedFile> sorted_by_time(std::vector<StampedFile> files) {
  std::stable_sort(files.begin(), files.end(),
                   [](const StampedFile& a, const StampedFile& b) { return a.utime < b.utime; });
  return files;
}

}  // namespace

ColourPairs pair_colour(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& colour) {
  ColourPairs pairs{{}, frame_interval(depth)};
  const std::vector<int> depth_parts = parts_of(depth), colour_parts = parts_of(colour);

  // Where the lists agree about the parts, colour is looked for in its own part only.
  const bool agree = !depth.empty() && !colour.empty() && depth_parts.back() == colour_parts.back();
  std::map<int, std::vector<StampedFile>> by_part;
  for (std::size_t i = 0; i < colour.size(); ++i) by_part[agree ? colour_parts[i] : 0].push_back(colour[i]);
  for (auto& [part, files] : by_part) files = sorted_by_time(std::move(files));

  // Else a colour image belongs to the first part in which it is the nearest.
  std::map<std::string, int> first_part;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    std::string file = nearest_file(by_part[agree ? depth_parts[i] : 0], depth[i].utime, pairs.window);
    if (!agree && first_part.try_emplace(file, depth_parts[i]).first->second != depth_parts[i]) file.clear();
    pairs.files.push_back(std::move(file));
  }
  return pairs;
}

}  // namespace barehand
