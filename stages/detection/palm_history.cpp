#include "stages/detection/palm_history.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

constexpr double kSame = 0.05;        // a palm that is farther away than this is another one [m]
constexpr double kSameLogOdds = 0.5;  // a palm's log odds that change by less are the same
constexpr double kUnlikely = 0;       // log odds of a hand below which a place is unlikely to be one
constexpr int kSkipAfter = 6;         // count per search in which a place is skipped: most hands are tracked before
constexpr int kMaxSkipped = 4;        // most searches in a row in which a place is skipped
constexpr int kRemembered = 5;        // frames without a palm after which a place is forgotten

double log_odds(double probability) { return std::log(probability / (1 - probability)); }

}  // namespace

void PalmHistory::begin_search() {
  ++search_;
  std::erase_if(places_, [&](const Place& place) { return search_ - place.last_palm > kRemembered; });
}

PalmHistory::Place* PalmHistory::find(const Eigen::Vector3d& palm) {
  const auto distance = [&](const Place& place) { return (place.palm - palm).norm(); };
  const auto nearest = std::ranges::min_element(places_, {}, distance);
  return nearest != places_.end() && distance(*nearest) < kSame ? &*nearest : nullptr;
}

bool PalmHistory::may_skip(const Eigen::Vector3d& palm, double probability) {
  Place* const place = find(palm);
  if (!place || !place->unlikely || search_ - place->last_examined > place->unlikely_count / kSkipAfter) return false;
  if (std::abs(log_odds(probability) - place->log_odds) >= kSameLogOdds) return false;
  place->last_palm = search_;
  return true;
}

void PalmHistory::examined(const Eigen::Vector3d& palm, double probability, const DetectedHand* found) {
  Place* place = find(palm);
  if (!place) place = &places_.emplace_back();
  place->palm = palm;
  place->log_odds = log_odds(probability);
  place->last_palm = place->last_examined = search_;
  place->unlikely = !found || found->hand_log_odds < kUnlikely;
  // A place that was read as both sides has been examined twice.
  const int examinations = found && found->other_joints ? 2 : 1;
  place->unlikely_count = place->unlikely ? std::min(kSkipAfter * kMaxSkipped, place->unlikely_count + examinations)
                                          : place->unlikely_count / 2;
}

}  // namespace barehand
