#pragma once

#include <memory>

#include "app/hand_tracker.h"

namespace barehand {

/// Whether a profile can be that of the hand in view, asked while it is searched for: a hand of the other side, a
/// child's or a giant's may be bent to it or never be found. Looks with the profile seen in a mirror and with smaller
/// and larger copies, and says in the log what it sees.
class ProfileCheck {
 public:
  /// `workers` outlives it.
  ProfileCheck(const TrackerParams& params, const HandProfile& profile, std::uint64_t seed, Workers& workers,
               std::shared_ptr<spdlog::logger> log);

  /// A search found the hand with `score`: whether the mirrored profile, looked for in the same way, explains it
  /// clearly better.
  bool is_other_side(const HandObservation& observation, Effort effort, int attempts, double score);
  /// A search found no hand, at best with `score` (infinite: nothing at all). Now and then another size is tried.
  void nothing_found(const HandObservation& observation, double score);

 private:
  HandTracker tracker_of(const HandProfile& profile) const;

  TrackerParams params_;
  HandProfile profile_;
  std::uint64_t seed_;
  Workers& workers_;
  std::shared_ptr<spdlog::logger> log_;
  std::unique_ptr<HandTracker> mirrored_;  // only looks
  bool said_side_ = false, said_size_ = false;
  int failures_ = 0, tries_ = 0;
};

}  // namespace barehand
