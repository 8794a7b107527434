#pragma once

#include <memory>
#include <optional>

#include "tracking/hand_tracker.h"

namespace barehand {

/// Checks whether a profile fits the hand in view at all. A hand of the other side, a child's or a very large hand may
/// be found with a wrong pose or not be found. While the hand is searched, and in the first frames of an uncertain
/// start, the check compares the profile with its mirror image and with smaller and larger copies, and reports in the
/// log what fits better.
class ProfileVerifier {
 public:
  /// `workers` must outlive this object.
  ProfileVerifier(const TrackerParams& params, const HandProfile& profile, std::uint64_t seed, Workers& workers,
                  std::shared_ptr<spdlog::logger> log);

  /// Call after a search of up to `attempts` found the hand with `score`. Returns whether the mirrored profile
  /// explains the observation clearly better after a similar search with fewer attempts. If it does not, but the score
  /// is not confident, a verification begins.
  bool is_other_side(const HandObservation& observation, Effort effort, int attempts, double score);

  /// Begins a verification, in which the mirrored profile is tracked, too, during the first frames of a track.
  /// `found`: the best pose that a search found for the mirrored profile. A single frame seldom distinguishes a hand
  /// from a distorted one of the other side; motion does.
  void begin_verification(const HandObservation& observation, std::optional<Hypothesis> found);
  void end_verification() { verification_.reset(); }
  bool verifying() const { return verification_.has_value(); }
  /// Tracks the mirrored profile in one frame of the verification.
  void track_mirrored(const HandObservation& observation);
  /// Call after that and after the profile's own frame. Returns whether the verification ends in favour of the other
  /// side.
  bool turns_out_other_side(const HandEstimate& own);
  /// Pose of the hand of the other side when the verification ended (T_camera_segment).
  const HandPose& mirrored_pose() const { return *mirrored_->view().whereabouts; }

  /// Call with an observation in which a pose of the profile was found or tracked with `score`. Returns the size of the
  /// hand in view relative to a profile that is not fitted while tracking, if the detected joints show another size
  /// and a copy of that size explains the observation clearly better. Of a track only the first frames are looked at.
  std::optional<double> other_size_in_view(const HandObservation& observation, double score);
  /// Call before that when a new track starts.
  void expect_any_size() { size_looks_ = 0; }

  /// Call when a search found no hand in a region that looks like one. `score`: that of the best pose; infinite if
  /// there was none. Now and then another size is tried.
  void nothing_found(const HandObservation& observation, double score);

 private:
  std::unique_ptr<HandTracker> tracker_of(const HandProfile& profile) const;
  HandTracker& other_side();
  // The size (its logarithm is about `log_size`) of a copy that explains the observation clearly better than `score`.
  std::optional<double> verified_size(const HandObservation& observation, double score, double log_size);
  // Reports a hand of the other side, once.
  void say_side();

  TrackerParams params_;
  HandProfile profile_;
  std::uint64_t seed_;
  Workers& workers_;
  std::shared_ptr<spdlog::logger> log_;
  std::unique_ptr<HandTracker> mirrored_;
  bool said_side_ = false, said_size_ = false;
  int failures_ = 0, tries_ = 0;
  int size_looks_ = 0;    // at detected joints of this track
  int size_refuted_ = 0;  // sizes that detected joints showed since the last one that was confirmed
  std::optional<double> confirmed_size_;

  struct Verification {
    int frames = 0, compared = 0;          // compared: frames in which both were tracked
    double own_sum = 0, mirrored_sum = 0;  // sums of the scores of these frames [m]
    HandEstimatePtr mirrored;
  };
  std::optional<Verification> verification_;
  int to_confirm_ =
      0;  // after a verification found the other side: searches that must still confirm the profile's own side
};

}  // namespace barehand
