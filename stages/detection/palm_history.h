#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "observe/detection.h"

namespace barehand {

/// Remembers where the first network found palms and how likely it was a hand that the second network found there. A
/// place that has been unlikely for a while is examined in every second search of the whole frame only, and after
/// longer in every fifth at last, unless its palm has changed. This depends on the frames alone, not on time.
class PalmHistory {
 public:
  /// Call once per search of the whole frame, before the other functions.
  void begin_search();
  /// Whether the place of a palm need not be examined in this search. `palm`: its centre as the first network reports
  /// it, camera frame [m]. `probability`: of a palm.
  bool may_skip(const Eigen::Vector3d& palm, double probability);
  /// States what was found at the place of a palm in this search; null: no hand.
  void examined(const Eigen::Vector3d& palm, double probability, const DetectedHand* found);

 private:
  struct Place {
    Eigen::Vector3d palm = Eigen::Vector3d::Zero();  // position of the palm when the place was last examined
    double log_odds = 0;                             // log odds of a palm when the place was last examined
    int unlikely_count = 0;                          // grows with each examination that found nothing likely
    bool unlikely = false;                           // whether the last examination found nothing likely
    std::int64_t last_palm = 0;                      // number of the last search with a palm here
    std::int64_t last_examined = 0;                  // number of the last search in which it was examined
  };
  /// The place of a palm; null if it is a new one.
  Place* find(const Eigen::Vector3d& palm);

  std::vector<Place> places_;
  std::int64_t search_ = 0;
};

}  // namespace barehand
