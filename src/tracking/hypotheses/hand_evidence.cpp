// Decides whether a detection is a hand.
#include "tracking/hypotheses/hand_evidence.h"

#include <algorithm>
#include <cmath>

#include "stages/search/inverse_kinematics.h"

namespace barehand {
namespace {

// Weights of the pose's global score and of its distance from the detected joints.
constexpr double kOfScore = -1.35, kOfDistance = -1.0;
// Added with the pose, instead of the score's part, where only the colour of skin was looked at: whatever has that
// colour is explained well by some pose of a hand, so that only the distance tells a hand.
constexpr double kOfPoseOnSkin = -0.25;
// Lower limits of the global score (kBest) and of the distance from the detected joints (kLeast), and the values of
// both for which they change the log odds neither way (kReference) [m].
constexpr double kBestScore = 0.0008, kReferenceScore = 0.0025, kLeastDistance = 0.002, kReferenceDistance = 0.015;
// The distance from the detected joints counts fully if the segments' mean matched fraction is at least this.
constexpr double kAllMatched = 0.3;

// Parameters of the accumulation of evidence over frames (HandEvidence).
constexpr double kKept = 0.9;          // factor by which the sum of earlier frames decays per frame
constexpr double kCounts = 0.1;        // weight of the sum of earlier frames, whose errors are mostly the same
constexpr double kApart = 0.1;         // a detection farther than this from all known places starts a new one [m]
constexpr std::uint32_t kFaded = 100;  // number of frames after which a place is forgotten

}  // namespace

double log_odds_of_pose(const RefinedPose& refined, const HandProfile& profile, const DetectedHand& detected) {
  double matched = 0;
  for (const double of_segment : refined.matched) matched += of_segment / kSegmentCount;
  const double distance =
      std::max(kLeastDistance, mean_distance(profile, refined.pose, detected.joints_of(profile.handedness)));
  const double too_far = std::min(1.0, matched / kAllMatched) * std::log(distance / kReferenceDistance);
  const double of_score =
      detected.skin_only ? kOfPoseOnSkin : kOfScore * std::log(std::max(kBestScore, refined.score) / kReferenceScore);
  return of_score + kOfDistance * too_far;
}

double HandEvidence::add(std::uint32_t frame, const Eigen::Vector3d& centre, double log_odds) {
  // Forget places without recent detections, and find the place nearest to this detection.
  std::erase_if(places_, [&](const Place& place) { return frame - place.frame > kFaded; });
  const auto distance = [&](const Place& place) { return (centre - place.centre).norm(); };
  auto place = std::ranges::min_element(places_, {}, distance);
  if (place == places_.end() || distance(*place) >= kApart) place = places_.insert(places_.end(), {.frame = frame});

  // Add the log odds to those of the place.
  if (frame != place->frame) {
    place->before = std::pow(kKept, frame - place->frame) * place->sum;
    place->frame = frame;
  }
  place->centre = centre;
  place->sum = std::max(0.0, place->before + log_odds);
  return log_odds + kCounts * place->before;
}

void HandEvidence::forget(const Eigen::Vector3d& centre) {
  std::erase_if(places_, [&](const Place& place) { return (centre - place.centre).norm() < kApart; });
}

}  // namespace barehand
