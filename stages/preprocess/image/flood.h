#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include "sensor/rgbd_frame.h"

namespace barehand {

/// The class of a pixel according to its own data: no data, hand, something else, or undecided. Undecided (open) pixels
/// get the class of their neighbours.
enum class Evidence : std::uint8_t { none = 0, hand = 1, other = 2, open = 3 };

/// Decides open pixels by their decided neighbours, most similar colours first (a watershed), so that skin in shadow
/// joins the neighbouring skin and not a sleeve. Deterministic: within a level of similarity, pixels are decided in the
/// order in which they were reached.
class Flood {
 public:
  /// `joined(i, j)`: neighbours i and j lie on one surface. Colour: black = none. Pixels that are joined to no decided
  /// pixel stay open.
  template <class Joined>
  void run(Image<Evidence>& evidence, const Image<Rgb>& colour, const Joined& joined) {
    for (std::vector<Step>& bucket : buckets_) bucket.clear();
    heads_.fill(0);

    // Begin with the open pixels next to decided ones.
    for (std::size_t i = 0; i < evidence.size(); ++i)
      if (evidence[i] == Evidence::open)
        for_neighbours(evidence, static_cast<std::int32_t>(i), [&](std::int32_t j) {
          if (decided(evidence[j]) && joined(static_cast<std::int32_t>(i), j))
            push(static_cast<std::int32_t>(i), evidence[j], colour[i], colour[j]);
        });

    // Next, decide the open pixel that is most similar to a decided neighbour.
    for (int level = 0; level < kLevels;) {
      if (heads_[level] == buckets_[level].size()) {
        ++level;
        continue;
      }
      const Step step = buckets_[level][heads_[level]++];
      if (evidence[step.pixel] != Evidence::open) continue;
      evidence[step.pixel] = step.evidence;

      // Queue its open neighbours, which may be even more similar.
      for_neighbours(evidence, step.pixel, [&](std::int32_t j) {
        if (evidence[j] == Evidence::open && joined(step.pixel, j))
          level = std::min(level, push(j, step.evidence, colour[step.pixel], colour[j]));
      });
    }
  }

 private:
  static constexpr int kLevels = 12;       // levels of similarity, from equal to most different
  static constexpr int kLevelWidth = 6;    // range of colour differences in one level, in units of an 8-bit channel
  static constexpr int kUnknownLevel = 6;  // level of similarity of two neighbours if one has no colour
  struct Step {
    std::int32_t pixel;
    Evidence evidence;
  };

  static bool decided(Evidence e) { return e == Evidence::hand || e == Evidence::other; }

  template <class Visit>
  static void for_neighbours(const Image<Evidence>& image, std::int32_t i, const Visit& visit) {
    const int width = image.width(), u = i % width, v = i / width;
    if (u > 0) visit(i - 1);
    if (u + 1 < width) visit(i + 1);
    if (v > 0) visit(i - width);
    if (v + 1 < image.height()) visit(i + width);
  }

  int push(std::int32_t pixel, Evidence evidence, Rgb a, Rgb b) {
    int level = kUnknownLevel;
    if (a != Rgb{} && b != Rgb{})
      level = std::min(kLevels - 1,
                       std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) / kLevelWidth);
    buckets_[level].push_back({pixel, evidence});
    return level;
  }

  std::array<std::vector<Step>, kLevels> buckets_;
  std::array<std::size_t, kLevels> heads_{};
};

}  // namespace barehand
