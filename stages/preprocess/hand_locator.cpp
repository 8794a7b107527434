#include "stages/preprocess/hand_locator.h"

#include <algorithm>
#include <cmath>

#include "math/share_along.h"

namespace barehand {
namespace {

// Finds the hands in the coarse grid: first near their predictions, then in the rest of the image.

constexpr float kOnModel = 0.02f;  // largest distance of a matching cell from the prediction's skin, after the
                                   // prediction was moved to this frame [m]

// A surface belongs to the hand if this fraction of its cells, or this number of cells, matches the prediction.
constexpr float kOwnShare = 0.3f;
constexpr int kOwnCells = 8;

// A surface with more cells farther than kLeakReach [m] from the predicted hand than kLeakFactor times the matching
// ones continues into a table or an object: only its part within kLeakReach is kept. A fist that opens stays below the
// limit.
constexpr float kLeakReach = 0.03f;
constexpr float kLeakFactor = 0.6f;

// Colour misleads where a surface of at least this area [m^2] continues beyond the hand, or where such an area of
// skin-like cells on the hand is labelled as something else.
constexpr float kTouchingArea = 0.0007f;

// Without colour, largest area of a separate surface, such as a cut-off finger, that may join a hand, as a fraction of
// the area of the hand's own surface.
constexpr float kLoosePart = 0.12f;
constexpr float kHandRadius = 0.13f;     // distance from a hand's centre to its farthest parts [m]
constexpr float kDetectedReach = 0.17f;  // distance from the middle of a palm to the farthest fingertip [m]
constexpr double kSamePalm = 0.07;       // distance between the middles of a palm as tracked and as detected [m]
constexpr float kSearchRadius = 0.22f;   // cells within this distance of a hand's centre are examined [m]
constexpr float kSideBySide = 0.10f;     // difference of depth up to which two candidates are equally near [m]
constexpr double kMetresAtRest = 0.06;   // motion that is allowed however short the frame interval is [m]
constexpr float kOnBones = 0.025f;  // distance from a detected bone up to which skin counts, whatever its label [m]
constexpr double kCloseBy = 0.05;   // motion that is allowed for a hand that touches a large surface [m]

/// Whether the networks decide where tracked hands are: they looked for them, and no colour shows where they are.
bool networks_decide(const CoarseGrid& grid, const Detection* detection) {
  return detection && detection->around_tracked && !grid.coloured;
}

/// Distance [m] of a point from the nearest bone of a detected hand.
float bone_distance(const DetectedHand& hand, const Eigen::Vector3f& p) {
  const auto joint = [&](int landmark) -> Eigen::Vector3f { return hand.joints[landmark].position.cast<float>(); };
  float nearest = INFINITY;
  for (int finger = 0; finger < kFingerCount; ++finger)
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3f start = joint(k == 0 ? kWristLandmark : landmark_of(finger, k - 1));
      nearest = std::min(nearest, segment_distance(start, joint(landmark_of(finger, k)), p));
    }
  return nearest;
}

}  // namespace

std::span<const CoarseHand> HandLocator::find(const CoarseGrid& grid, const StandingDepth& standing,
                                              std::span<const HandEstimatePtr> feedback, double feedback_age,
                                              const Detection* detection) {
  // Colour, if there is any and if it does not mislead, is better evidence than labels.
  finder_.find(grid, params_, all_candidates_);
  use_labels_ = detection && (!grid.coloured || colour_misleads_);
  if (use_labels_) remove_labelled(grid, *detection);
  colour_misleads_ = false;  // until something touches a hand
  locate(grid, standing, feedback, feedback_age, detection);
  return hands_;
}

void HandLocator::locate(const CoarseGrid& grid, const StandingDepth& standing,
                         std::span<const HandEstimatePtr> feedback, double feedback_age, const Detection* detection) {
  // Predict each hand by the feedback, and forget the previous frame.
  const auto tracked = [&](std::size_t k) { return predictions_[k] && feedback[k]->status == TrackStatus::tracking; };
  predictions_.assign(hands_.size(), std::nullopt);
  for (std::size_t k = 0; k < feedback.size(); ++k) predictions_[k] = PredictedHand::from(feedback[k].get());

  for (CoarseHand& hand : hands_) {
    hand.found = hand.followed = hand.labelled = false;
    hand.prediction.reset();
    hand.wrist.reset();
    hand.detected = hand.second_look = nullptr;
    hand.standing = nullptr;
    hand.cells.reset(grid.z.width(), grid.z.height());
  }

  // Follow the tracked hands first. A candidate near two of them belongs to the nearer one.
  for (std::size_t k = 0; k < hands_.size(); ++k) {
    if (!tracked(k)) continue;
    candidates_ = all_candidates_;
    for (int v = 0; v < grid.z.height(); ++v)
      for (int u = 0; u < grid.z.width(); ++u)
        if (candidates_.at(u, v) && StandingDepth::agrees(grid.z.at(u, v), standing.depth(u, v)))
          candidates_.at(u, v) = 0;
    hands_[k].standing = &standing;
    for (std::size_t other = 0; other < hands_.size(); ++other)
      if (other != k && tracked(other)) remove_nearer_to(grid, *predictions_[other], *predictions_[k]);
    split_surfaces(grid, candidates_, surfaces_);
    hands_[k].found = hands_[k].followed = follow(grid, *predictions_[k], true, feedback_age, detection, hands_[k]);
  }

  // Follow the hands that have a pose but are not tracked, among the candidates that are left.
  if (std::ranges::all_of(hands_, &CoarseHand::found)) return;
  candidates_ = all_candidates_;
  for (const CoarseHand& hand : hands_)
    if (hand.followed) remove_hand(grid, hand);

  for (std::size_t k = 0; k < hands_.size(); ++k) {
    CoarseHand& hand = hands_[k];
    if (hand.found || !predictions_[k] || tracked(k)) continue;
    split_surfaces(grid, candidates_, surfaces_);
    hand.found = hand.followed = follow(grid, *predictions_[k], false, feedback_age, detection, hand);
    if (hand.found) remove_hand(grid, hand);
  }
  for (CoarseHand& hand : hands_) {  // hands without a match come last, as a held hand may be the nearest candidate
    if (hand.found) continue;
    hand.standing = nullptr;  // the hand may be what stood there

    // Start where the networks found a hand, if only such hands may start; else at the most plausible surface.
    if (detection && (detection->whole_frame || networks_decide(grid, detection))) {
      const DetectedHand* const detected = choose_detected(*detection);
      hand.found = detected && start_at(grid, *detected, hand);
    } else {
      split_surfaces(grid, candidates_, surfaces_);
      hand.found = start(grid, hand);
    }

    if (hand.found) remove_hand(grid, hand);
  }
}

/// Removes the candidates that are in a window of the detection and not labelled as hand.
void HandLocator::remove_labelled(const CoarseGrid& grid, const Detection& detection) {
  labelled_.reset(grid.z.width(), grid.z.height());
  for (int v = 0; v < grid.z.height(); ++v)
    for (int u = 0; u < grid.z.width(); ++u) {
      std::uint8_t& candidate = all_candidates_.at(u, v);
      if (!candidate) continue;

      // Look up the label of the cell in each window that covers it.
      const Eigen::Vector2d pixel = grid.frame_pixel(u, v);
      bool covered = false, is_hand = false, is_arm = false;
      for (const DetectedHand& hand : detection.hands) {
        if (!hand.labels.covers(pixel.x(), pixel.y())) continue;
        covered = true;
        const SurfaceLabel label = hand.labels.at(pixel.x(), pixel.y());
        is_hand |= label == SurfaceLabel::hand;
        is_arm |= label == SurfaceLabel::arm;
      }

      if (covered && !is_hand) {
        candidate = 0;
        labelled_.at(u, v) = !is_arm;
      }
    }
}

const DetectedHand* HandLocator::detected_near(std::span<const DetectedHand> hands, const Eigen::Vector3f& centre,
                                               double reach) const {
  const DetectedHand* nearest = nullptr;
  for (const DetectedHand& hand : hands) {
    const double distance = (hand.centre - centre.cast<double>()).norm();
    if (distance >= reach) continue;
    reach = distance;
    nearest = &hand;
  }
  return nearest;
}

/// The most probable detected hand within the working range that is not assigned to a hand of this frame yet; null if
/// there is none.
const DetectedHand* HandLocator::choose_detected(const Detection& detection) const {
  const auto taken = [&](const DetectedHand& detected) {
    return std::ranges::any_of(hands_, [&](const CoarseHand& hand) {
      if (hand.detected) return hand.detected == &detected;
      return hand.prediction && (hand.prediction->centre().cast<double>() - detected.centre).norm() < kHandRadius;
    });
  };
  for (const DetectedHand& hand : detection.hands)
    if (hand.centre.z() >= params_.min_depth && hand.centre.z() <= params_.max_depth && !taken(hand)) return &hand;
  return nullptr;
}

/// Sets the cells of a detected hand: candidates labelled as hand, within a hand's reach and in front of its wrist. In
/// depth, a palm may look like a held object, so cells labelled as object count as hand if their colour is clearly skin
/// and they are near the detected bones.
bool HandLocator::start_at(const CoarseGrid& grid, const DetectedHand& detected, CoarseHand& hand) {
  hand.detected = &detected;
  hand.labelled = !grid.coloured;
  const Eigen::Vector3f wrist = detected.joints[kWristLandmark].position.cast<float>();
  const Eigen::Vector3f knuckle = detected.joints[kMiddleKnuckleLandmark].position.cast<float>();
  const Eigen::Vector3f axis = (wrist - knuckle).normalized();
  hand.wrist = WristPlane{wrist + static_cast<float>(params_.wrist_margin) * axis, axis};

  // Mark the cells that belong to the hand.
  const Eigen::Vector3f centre = detected.centre.cast<float>();
  for (int v = 0; v < grid.z.height(); ++v)
    for (int u = 0; u < grid.z.width(); ++u) {
      const Eigen::Vector2d pixel = grid.frame_pixel(u, v);
      if (!candidates_.at(u, v) || !detected.labels.covers(pixel.x(), pixel.y())) continue;

      const SurfaceLabel label = detected.labels.at(pixel.x(), pixel.y());
      const Eigen::Vector3f p = grid.point(u, v);
      const bool skin = grid.coloured && grid.odds.at(u, v) > params_.skin_odds;
      const bool is_hand = label == SurfaceLabel::hand ||
                           (skin && label == SurfaceLabel::object && bone_distance(detected, p) < kOnBones);
      hand.cells.at(u, v) = is_hand && hand.wrist->behind(p) <= 0 && (p - centre).norm() < kDetectedReach;
    }
  return hand_area(grid, hand) >= params_.min_hand_area;
}

/// Removes the candidates that are nearer to the hand `other` than to the hand `own`.
void HandLocator::remove_nearer_to(const CoarseGrid& grid, const PredictedHand& other, const PredictedHand& own) {
  for (int v = 0; v < grid.z.height(); ++v)
    for (int u = 0; u < grid.z.width(); ++u) {
      if (!candidates_.at(u, v)) continue;
      const Eigen::Vector3f p = grid.point(u, v);
      if ((p - other.centre()).squaredNorm() > kSearchRadius * kSearchRadius) continue;
      if (other.distance(p) < own.distance(p)) candidates_.at(u, v) = 0;
    }
}

/// Removes a hand that was found, and its forearm, from the candidates for the other hands.
void HandLocator::remove_hand(const CoarseGrid& grid, const CoarseHand& hand) {
  for (int v = 0; v < grid.z.height(); ++v)
    for (int u = 0; u < grid.z.width(); ++u) {
      std::uint8_t& candidate = candidates_.at(u, v);
      if (!candidate) continue;
      if (hand.cells.at(u, v)) {
        candidate = 0;
      } else if (hand.wrist && hand.wrist->on_forearm(grid.point(u, v))) {
        candidate = 0;
      }
    }
}

float HandLocator::hand_area(const CoarseGrid& grid, const CoarseHand& hand) const {
  float area = 0;
  for (std::size_t i = 0; i < hand.cells.size(); ++i)
    if (hand.cells[i]) area += grid.cell_area(grid.z[i]);
  return area;
}

std::optional<Eigen::Vector3f> HandLocator::motion(const CoarseGrid& grid, const PredictedHand& hand, double reach) {
  // Search without large surfaces first: on a wall, table or occluder, the hand would fit anywhere.
  movable_.reset(grid.z.width(), grid.z.height());
  for (std::size_t i = 0; i < movable_.size(); ++i)
    movable_[i] = candidates_[i] && surfaces_.parts[surfaces_.id[i]].area < params_.max_hand_area;
  if (const auto step = translation_.find(hand, grid, movable_, reach)) return step;
  // The hand may touch a large surface, so include these surfaces, but only close to the prediction.
  for (int v = 0; v < grid.z.height(); ++v)
    for (int u = 0; u < grid.z.width(); ++u) {
      if (!candidates_.at(u, v) || movable_.at(u, v)) continue;
      const Eigen::Vector3f p = grid.point(u, v);
      movable_.at(u, v) = (p - hand.centre()).squaredNorm() < kSearchRadius * kSearchRadius &&
                          hand.distance(p) < static_cast<float>(kCloseBy);
    }
  return translation_.find(hand, grid, movable_, std::min(reach, kCloseBy));
}

bool HandLocator::follow(const CoarseGrid& grid, PredictedHand body, bool tracked, double feedback_age,
                         const Detection* detection, CoarseHand& hand) {
  // Move the predicted hand to its place in this frame.
  const auto step = motion(grid, body, kMetresAtRest + params_.max_speed * std::clamp(feedback_age, 0.0, 0.5));
  if (!step) return false;
  body.translate(*step);

  // Without colour, what the networks do not see as a hand is none: the track has slipped onto the arm or an object.
  const DetectedHand* const detected = detection ? detected_near(detection->hands, body.centre(), kSamePalm) : nullptr;
  if (tracked && networks_decide(grid, detection) && !detected) return false;
  const float margin = static_cast<float>(params_.wrist_margin);

  // Compute the distance of each cell from the predicted hand.
  match_counts_.assign(surfaces_.parts.size(), {});
  hand.distance.reset(grid.z.width(), grid.z.height(), INFINITY);
  for (int v = 0; v < grid.z.height(); ++v)
    for (int u = 0; u < grid.z.width(); ++u) {
      const std::int32_t id = surfaces_.id.at(u, v);
      if (id < 0) continue;

      const Eigen::Vector3f p = grid.point(u, v);
      if ((p - body.centre()).squaredNorm() > kSearchRadius * kSearchRadius || body.behind_wrist(p) > margin) continue;
      const float d = hand.distance.at(u, v) = body.distance(p);

      // Count for each surface how many of its cells are near the prediction, and how many are far from it.
      match_counts_[id].on_model += d < kOnModel;
      match_counts_[id].off_model += d > kLeakReach;
    }

  // Take the cells near the prediction, unless only a small part of their surface is there. If most of a surface is far
  // from the prediction, the limit is smaller.
  for (std::size_t i = 0; i < hand.distance.size(); ++i) {
    const std::int32_t id = surfaces_.id[i];
    if (id < 0 || std::isinf(hand.distance[i])) continue;
    const MatchCounts& own = match_counts_[id];
    if (own.on_model < kOwnCells && own.on_model < kOwnShare * surfaces_.parts[id].cells) continue;
    const bool leaks = own.off_model > kLeakFactor * own.on_model;
    colour_misleads_ |= leaks && grid.coloured && surfaces_.parts[id].area > kTouchingArea;
    hand.cells[i] = hand.distance[i] < (leaks ? kLeakReach : static_cast<float>(params_.hand_reach));
  }

  // Too small an area is not a hand.
  if (hand_area(grid, hand) < params_.min_hand_area) {
    hand.cells.reset(grid.z.width(), grid.z.height());
    return false;
  }

  // Where colour misled in the last frame, find out whether it still would.
  if (use_labels_ && grid.coloured) colour_misleads_ |= touches_labelled(grid, body);

  // Store the prediction, the detection and the wrist for the next steps.
  hand.prediction = body;
  hand.detected = detected;
  hand.labelled = use_labels_ && hand.detected;
  if (detection && detection->second_look)
    hand.second_look = detected_near({&*detection->second_look, 1}, body.centre(), kHandRadius);
  hand.wrist = WristPlane{body.wrist() + margin * body.arm_axis(), body.arm_axis()};
  return true;
}

/// Whether a thing that only labels tell from the hand touches it.
bool HandLocator::touches_labelled(const CoarseGrid& grid, const PredictedHand& body) const {
  float area = 0;
  for (int v = 0; v < grid.z.height(); ++v)
    for (int u = 0; u < grid.z.width(); ++u)
      if (labelled_.at(u, v) && body.distance(grid.point(u, v)) < kLeakReach) area += grid.cell_area(grid.z.at(u, v));
  return area > kTouchingArea;
}

int HandLocator::choose_part(const CoarseGrid& grid) const {
  const double least = std::max(params_.min_hand_area, grid.coloured ? 0.0015 : 0.004);
  int best = -1;
  for (int i = 0; i < static_cast<int>(surfaces_.parts.size()); ++i) {
    const Components::Part& part = surfaces_.parts[i];
    if (part.area < least || part.area > params_.max_hand_area) continue;

    // Prefer the nearest surface, and among equally near ones the largest.
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

bool HandLocator::start(const CoarseGrid& grid, CoarseHand& hand) {
  const int chosen = choose_part(grid);
  if (chosen < 0) return false;
  hand.wrist = find_wrist(grid, surfaces_, chosen);

  // Prepare the tests for what is left out: the forearm, and surfaces that are too large to be a part of a hand.
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  int count = 0;
  const auto forearm = [&](const Eigen::Vector3f& p) { return hand.wrist && hand.wrist->behind(p) > 0; };
  const float largest = (grid.coloured ? 0.5f : kLoosePart) * surfaces_.parts[chosen].area;

  // Mark the cells of the hand.
  for (int pass = 0; pass < 2; ++pass)  // pass 0: the chosen surface and its centre; 1: others near it
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
        hand.cells.at(u, v) = 1;
      }

  return hand_area(grid, hand) >= params_.min_hand_area;
}

}  // namespace barehand
