// Decides whether colour shows where hands are.
#include "stages/preprocess/colour_trust.h"

#include <algorithm>
#include <utility>

namespace barehand {
namespace {

// Cells that the networks' labels or the tracker say are hand, and those of them that have the colour of skin.
struct Counts {
  int hand = 0, skin = 0;
  void add(float odds) { ++hand, skin += odds > 0; }
  bool enough() const { return hand >= kFewestCells; }
  bool below(double share) const { return skin < share * hand; }

 private:
  static constexpr int kFewestCells = 20;  // fewer cells tell nothing
};

constexpr double kHardlySkin = 0.15;  // share of skin below which colour does not show a hand
constexpr double kMostlySkin = 0.6;   // share of skin from which colour shows a hand again
constexpr float kAround = 0.12f;      // cells farther than this from the middle of a palm are not counted [m]

Counts colours_of(const DetectedHand& hand, const CoarseGrid& grid) {
  Counts counts;
  for (int r = 0; r < grid.z.height(); ++r)
    for (int c = 0; c < grid.z.width(); ++c) {
      if (grid.z.at(c, r) <= 0) continue;
      const Eigen::Vector2d pixel = grid.frame_pixel(c, r);
      if (!hand.labels.covers(pixel.x(), pixel.y()) || hand.labels.at(pixel.x(), pixel.y()) != SurfaceLabel::hand)
        continue;
      if ((grid.point(c, r) - hand.centre.cast<float>()).norm() < kAround) counts.add(grid.odds.at(c, r));
    }
  return counts;
}

}  // namespace

bool ColourTrust::trusts(std::int64_t number, const CoarseGrid& grid, std::span<const HandEstimatePtr> feedback,
                         const Detection* detection) {
  const bool trusted = decide(grid, feedback, detection);
  decisions_[slot(number)] = {number, trusted};
  number_ = number;
  return trusted;
}

bool ColourTrust::decide(const CoarseGrid& grid, std::span<const HandEstimatePtr> feedback,
                         const Detection* detection) {
  // Tracked hands are followed as they were found. The frames between the first pose and its feedback may have been
  // decided otherwise.
  bool any = false, found_by_colour = false;
  for (const HandEstimatePtr& hand : feedback) {
    if (!hand || !hand->has_pose()) continue;
    any = true;
    found_by_colour |= decided(hand->number);
  }
  const bool was_followed = std::exchange(followed_, any);
  if (any) return was_followed ? trusted() : found_by_colour;

  // The most probable hand decides, unless it was found among what has the colour of skin.
  if (!detection || detection->hands.empty() || detection->hands.front().skin_only) return true;
  const Counts counts = colours_of(detection->hands.front(), grid);
  return !counts.enough() || !counts.below(kHardlySkin);
}

bool ColourTrust::decided(std::int64_t number) const {
  const Decision& decision = decisions_[slot(number)];
  return decision.number != number || decision.trusted;
}

void ColourTrust::learn(const CoarseGrid& grid, std::span<const CoarseHand> hands) {
  if (trusted()) return;
  Counts counts;
  for (const CoarseHand& hand : hands)
    for (std::size_t i = 0; hand.followed && i < hand.cells.size(); ++i)
      if (hand.cells[i]) counts.add(grid.odds[i]);
  decisions_[slot(number_)].trusted = counts.enough() && !counts.below(kMostlySkin);
}

}  // namespace barehand
