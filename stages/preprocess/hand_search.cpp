#include "stages/preprocess/hand_search.h"

#include <algorithm>
#include <cmath>

#include "stages/preprocess/alignment.h"

namespace barehand {
namespace {

constexpr float kOnModel = 0.02f;  // m between data and the moved hint that still means "this is it"
constexpr float kOwnShare = 0.3f;  // share of a surface that must lie on the hint, unless the surface is large
constexpr int kOwnCells = 8;
constexpr float kLeakReach = 0.03f;     // m around the hint kept of a surface that runs on into table or object
constexpr float kLeakFactor = 0.6f;     // cells off the hint against cells on it; a fist that opens stays below
constexpr float kLoosePart = 0.12f;     // share of the hand that a finger cut off by another one may have
constexpr float kHandRadius = 0.13f;    // m from a hand's centre to its farthest parts
constexpr float kSearchRadius = 0.22f;  // m around the hand that is looked at cell by cell
constexpr float kSideBySide = 0.10f;    // m of depth within which two candidates count as equally near
constexpr double kMetresAtRest = 0.06;  // m, motion allowed whatever the time between
constexpr double kCloseBy = 0.05;       // m, motion allowed for a hand that touches something large

}  // namespace

const CoarseHand& HandSearch::find(const CoarseGrid& grid, const HandEstimate* hint, double hint_age) {
  hand_.found = false;
  hand_.prediction.reset();
  hand_.wrist.reset();
  hand_.cells.reset(grid.z.width(), grid.z.height());
  finder_.find(grid, params_, candidates_);
  split_surfaces(grid, candidates_, surfaces_);
  hand_.found = (hint && follow(grid, *hint, hint_age)) || start(grid);
  return hand_;
}

float HandSearch::hand_area(const CoarseGrid& grid) const {
  float area = 0;
  for (std::size_t i = 0; i < hand_.cells.size(); ++i)
    if (hand_.cells[i]) area += grid.cell_area(grid.z[i]);
  return area;
}

std::optional<Eigen::Vector3f> HandSearch::motion(const CoarseGrid& grid, const PredictedHand& hand, double reach) {
  // A wall, table or occluder would explain a hand anywhere on it.
  movable_.reset(grid.z.width(), grid.z.height());
  for (std::size_t i = 0; i < movable_.size(); ++i)
    movable_[i] = candidates_[i] && surfaces_.parts[surfaces_.id[i]].area < params_.max_hand_area;
  if (const auto step = align_translation(hand, grid, movable_, reach)) return step;
  // The hand may touch such a surface: then it is looked for close by only.
  for (int v = 0; v < grid.z.height(); ++v)
    for (int u = 0; u < grid.z.width(); ++u) {
      if (!candidates_.at(u, v) || movable_.at(u, v)) continue;
      const Eigen::Vector3f p = grid.point(u, v);
      movable_.at(u, v) = (p - hand.centre()).squaredNorm() < kSearchRadius * kSearchRadius &&
                          hand.distance(p) < static_cast<float>(kCloseBy);
    }
  return align_translation(hand, grid, movable_, std::min(reach, kCloseBy));
}

bool HandSearch::follow(const CoarseGrid& grid, const HandEstimate& hint, double hint_age) {
  std::optional<PredictedHand> hand = PredictedHand::from(&hint);
  if (!hand) return false;
  const auto step = motion(grid, *hand, kMetresAtRest + params_.max_speed * std::clamp(hint_age, 0.0, 0.5));
  if (!step) return false;
  hand->translate(*step);
  const float margin = static_cast<float>(params_.wrist_margin);

  struct Share {
    int on_model = 0, off_model = 0;  // cells near the hand
  };
  std::vector<Share> share(surfaces_.parts.size());
  hand_.distance.reset(grid.z.width(), grid.z.height(), INFINITY);
  for (int v = 0; v < grid.z.height(); ++v)
    for (int u = 0; u < grid.z.width(); ++u) {
      const std::int32_t id = surfaces_.id.at(u, v);
      if (id < 0) continue;
      const Eigen::Vector3f p = grid.point(u, v);
      if ((p - hand->centre()).squaredNorm() > kSearchRadius * kSearchRadius || hand->behind_wrist(p) > margin)
        continue;
      const float d = hand_.distance.at(u, v) = hand->distance(p);
      share[id].on_model += d < kOnModel;
      share[id].off_model += d > kLeakReach;
    }
  for (std::size_t i = 0; i < hand_.distance.size(); ++i) {
    const std::int32_t id = surfaces_.id[i];
    if (id < 0 || std::isinf(hand_.distance[i])) continue;
    const Share& own = share[id];
    if (own.on_model < kOwnCells && own.on_model < kOwnShare * surfaces_.parts[id].cells) continue;
    const bool leaks = own.off_model > kLeakFactor * own.on_model;
    hand_.cells[i] = hand_.distance[i] < (leaks ? kLeakReach : static_cast<float>(params_.hand_reach));
  }
  if (hand_area(grid) < params_.min_hand_area) {
    hand_.cells.reset(grid.z.width(), grid.z.height());
    return false;
  }
  hand_.prediction = hand;
  hand_.wrist = WristPlane{hand->wrist() + margin * hand->arm_axis(), hand->arm_axis()};
  return true;
}

int HandSearch::choose_part(const CoarseGrid& grid) const {
  const double least = std::max(params_.min_hand_area, grid.coloured ? 0.0015 : 0.004);
  int best = -1;
  for (int i = 0; i < static_cast<int>(surfaces_.parts.size()); ++i) {
    const Components::Part& part = surfaces_.parts[i];
    if (part.area < least || part.area > params_.max_hand_area) continue;
    if (best >= 0) {
      const Components::Part& other = surfaces_.parts[best];
      const bool nearer = part.mean_z < other.mean_z - kSideBySide;
      const bool as_near = std::abs(part.mean_z - other.mean_z) <= kSideBySide;
      if (!nearer && !(as_near && part.area > other.area)) continue;
    }
    best = i;
  }
  return best;
}

bool HandSearch::start(const CoarseGrid& grid) {
  const int chosen = choose_part(grid);
  if (chosen < 0) return false;
  hand_.wrist = find_wrist(grid, surfaces_, chosen);
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  int count = 0;
  const auto forearm = [&](const Eigen::Vector3f& p) { return hand_.wrist && hand_.wrist->behind(p) > 0; };
  const float largest = (grid.coloured ? 0.5f : kLoosePart) * surfaces_.parts[chosen].area;
  for (int pass = 0; pass < 2; ++pass)  // the chosen surface gives the centre, then all others near it join
    for (int v = 0; v < grid.z.height(); ++v)
      for (int u = 0; u < grid.z.width(); ++u) {
        const std::int32_t id = surfaces_.id.at(u, v);
        if (id < 0 || (id == chosen) != (pass == 0)) continue;
        const Eigen::Vector3f p = grid.point(u, v);
        if (forearm(p)) continue;
        if (pass == 0) {
          centre += p;
          ++count;
        } else if (count == 0 || surfaces_.parts[id].area > largest ||
                   (p - centre / static_cast<float>(count)).norm() > kHandRadius) {
          continue;
        }
        hand_.cells.at(u, v) = 1;
      }
  return hand_area(grid) >= params_.min_hand_area;
}

}  // namespace barehand
