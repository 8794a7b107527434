#include "stages/preprocess/hand_search.h"

#include <algorithm>
#include <cmath>

#include "stages/preprocess/alignment.h"

namespace barehand {
namespace {

constexpr float kOnModel = 0.02f;  // m between data and the moved hint that still means "this is it"
constexpr float kOwnShare = 0.3f;  // share of a surface that must lie on the hint, unless the surface is large
constexpr int kOwnCells = 8;
constexpr float kLeakReach = 0.03f;     // m around the hint kept of a surface that runs on into other things
constexpr float kLeakFactor = 2.f;      // area of such a surface against the hint's silhouette
constexpr float kHandRadius = 0.13f;    // m from a hand's centre to its farthest parts
constexpr float kSearchRadius = 0.22f;  // m around the hand that is looked at cell by cell
constexpr float kSideBySide = 0.10f;    // m of depth within which two candidates count as equally near
constexpr float kMetresAtRest = 0.06f;  // m, motion allowed whatever the time between

}  // namespace

const CoarseHand& HandSearch::find(const CoarseGrid& grid, const HandEstimate* hint, double hint_age) {
  hand_.found = false;
  hand_.prediction.reset();
  hand_.wrist.reset();
  hand_.cells.reset(grid.z.width(), grid.z.height());
  skin_cells(grid, static_cast<float>(params_.skin_odds), queue_, candidates_);
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

bool HandSearch::follow(const CoarseGrid& grid, const HandEstimate& hint, double hint_age) {
  std::optional<PredictedHand> hand = PredictedHand::from(&hint);
  if (!hand) return false;
  const double reach = kMetresAtRest + params_.max_speed * std::clamp(hint_age, 0.0, 0.5);
  const auto step = align_translation(*hand, grid, candidates_, reach);
  if (!step) return false;
  hand->translate(*step);
  const float margin = static_cast<float>(params_.wrist_margin);

  struct Share {
    int on_model = 0;
    float area = 0;
  };
  std::vector<Share> share(surfaces_.parts.size());
  Image<float> distance(grid.z.width(), grid.z.height(), INFINITY);
  float silhouette = 0;
  for (int v = 0; v < distance.height(); ++v)
    for (int u = 0; u < distance.width(); ++u) {
      const std::int32_t id = surfaces_.id.at(u, v);
      if (id < 0) continue;
      const Eigen::Vector3f p = grid.point(u, v);
      if ((p - hand->centre()).squaredNorm() > kSearchRadius * kSearchRadius || hand->behind_wrist(p) > margin)
        continue;
      const float d = distance.at(u, v) = hand->distance(p);
      share[id].on_model += d < kOnModel;
      share[id].area += grid.cell_area(p.z());
      if (d < kOnModel) silhouette += grid.cell_area(p.z());
    }
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const std::int32_t id = surfaces_.id[i];
    if (id < 0 || std::isinf(distance[i])) continue;
    const Share& own = share[id];
    if (own.on_model < kOwnCells && own.on_model < kOwnShare * surfaces_.parts[id].cells) continue;
    // Without colour a surface may run on into table or object; what is far from the hint is not kept then.
    const bool leaks = !grid.coloured && own.area > kLeakFactor * silhouette;
    hand_.cells[i] = distance[i] < (leaks ? kLeakReach : static_cast<float>(params_.hand_reach));
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
        } else if (count == 0 || surfaces_.parts[id].area > 0.5f * surfaces_.parts[chosen].area ||
                   (p - centre / static_cast<float>(count)).norm() > kHandRadius) {
          continue;
        }
        hand_.cells.at(u, v) = 1;
      }
  return hand_area(grid) >= params_.min_hand_area;
}

}  // namespace barehand
