#include "stages/preprocess/standing_depth.h"

#include <algorithm>
#include <cstdlib>

namespace barehand {
namespace {

// Learns what stands in the scene, and forgets what has moved.

constexpr float kReach = 0.17f;       // distance from a hand's centre within which its fingers may be [m]
constexpr float kRate = 0.2f;         // weight of one frame in the remembered depth
constexpr float kOldest = 1.f;        // the time without a change counts up to this [s]
constexpr float kLongestStep = 0.1f;  // the time between two frames counts up to this [s]

/// Whether the point of a cell may be on the hand, also if its pose is wrong, or on its forearm.
bool near_hand(const CoarseHand& hand, int column, int row, const Eigen::Vector3f& p) {
  if (!hand.found) return false;
  return hand.cells.at(column, row) || (hand.wrist && hand.wrist->on_forearm(p)) ||
         (hand.prediction && (p - hand.prediction->centre()).squaredNorm() < kReach * kReach);
}

}  // namespace

bool StandingDepth::sensor_moved(const CoarseGrid& grid) const {
  // What is nearer than before may be a hand.
  int unchanged = 0, farther = 0;
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    const bool stands = seconds_[i] >= kStands, same = agrees(grid.z[i], depth_[i]);
    unchanged += stands & same;
    farther += stands & !same & (grid.z[i] > depth_[i]);
  }
  return farther > unchanged;
}

void StandingDepth::forget_around(const CoarseGrid& grid, const CoarseHand& hand) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  int count = 0;
  for (int r = 0; r < grid.z.height(); ++r)
    for (int c = 0; c < grid.z.width(); ++c) {
      if (!hand.cells.at(c, r)) continue;
      sum += grid.point(c, r);
      ++count;
    }
  if (count == 0) return;

  const Eigen::Vector3f centre = sum / static_cast<float>(count);
  for (int r = 0; r < grid.z.height(); ++r)
    for (int c = 0; c < grid.z.width(); ++c)
      if ((grid.point(c, r) - centre).squaredNorm() < kReach * kReach) seconds_.at(c, r) = 0;
}

void StandingDepth::update(const CoarseGrid& grid, std::span<const CoarseHand> hands, std::int64_t utime) {
  const float step = std::min(kLongestStep, static_cast<float>(std::abs(static_cast<double>(utime - utime_)) * 1e-6));
  utime_ = utime;

  // Forget what cannot be trusted any more.
  if (depth_.width() != grid.z.width() || depth_.height() != grid.z.height() || sensor_moved(grid)) {
    depth_.reset(grid.z.width(), grid.z.height());
    seconds_.reset(grid.z.width(), grid.z.height());
  }
  for (const CoarseHand& hand : hands)
    if (hand.found && !hand.standing) forget_around(grid, hand);

  // Visit the cells that may be skin; the colour of the others tells them from a hand.
  for (int r = 0; r < grid.z.height(); ++r)
    for (int c = 0; c < grid.z.width(); ++c) {
      const float z = grid.z.at(c, r);
      if (z <= 0 || (grid.coloured && grid.odds.at(c, r) < 0)) continue;
      float &depth = depth_.at(c, r), &seconds = seconds_.at(c, r);
      const bool unchanged = agrees(z, depth);

      // A hand may be in front of what stands, but does not let see through it.
      const auto near = [&](const CoarseHand& hand) { return near_hand(hand, c, r, grid.point(c, r)); };
      const bool settled = unchanged && seconds >= kOldest;
      if (!settled && std::ranges::any_of(hands, near)) {
        if (!unchanged && z > depth) seconds = 0;
        continue;
      }

      // Elsewhere, what is unchanged grows older. What differs replaces it after as long, so that noise does not.
      if (unchanged) {
        depth += kRate * (z - depth);
        seconds = std::min(kOldest, seconds + step);
      } else {
        seconds -= step;
        if (seconds > 0) continue;
        depth = z;
        seconds = 0;
      }
    }
}

}  // namespace barehand
