#pragma once

#include <memory>
#include <optional>

#include "tracking/hand_tracker.h"
#include "tracking/hypotheses/hand_evidence.h"

namespace barehand {

/// Checks whether a profile fits the hand in view at all. A hand of the other side, a child's hand or a very large hand
/// may be found with a wrong pose, or not at all. While the hand is searched, and in the first frames of an uncertain
/// start, the check compares the profile with its mirror image and with smaller and larger copies, and logs which of
/// them fits better.
class ProfileVerifier {
 public:
  /// `skin`: of the profile. `workers` must outlive this object.
  ProfileVerifier(const TrackerParams& params, const HandProfile& profile, std::shared_ptr<const Skin> skin,
                  std::uint64_t seed, Workers& workers, std::shared_ptr<spdlog::logger> log);

  /// Call once for each frame in which the hand is searched. Returns whether the networks are sure, by this and earlier
  /// frames, that the detected hand is of the other side. If so, reports it.
  bool is_detected_as_other_side(const HandObservation& observation);

  /// Call after a search with up to `attempts` attempts found the hand with `score` [m]. Unless the networks are sure
  /// of the profile's side, searches with the mirrored profile, with fewer attempts, and returns whether that explains
  /// the observation clearly better. After a verification found the other side, it returns true until the profile's
  /// side has won several successive searches. If it returns false but the score is not confident, a verification
  /// begins.
  bool is_other_side(const HandObservation& observation, Effort effort, int attempts, double score);

  /// Begins a verification: during the first frames of a track, the mirrored profile is tracked, too. A single frame
  /// seldom distinguishes a hand from a distorted one of the other side; several frames of its motion do. `found`: the
  /// best pose that a search found for the mirrored profile.
  void begin_verification(const HandObservation& observation, std::optional<Hypothesis> found);
  void end_verification() { verification_.reset(); }
  bool verifying() const { return verification_.has_value(); }
  /// Tracks the mirrored profile in one frame of the verification.
  void track_mirrored(const HandObservation& observation);
  /// Call after track_mirrored(). `own`: the estimate of the same frame with the profile itself. Returns whether the
  /// verification ends in favour of the other side.
  bool turns_out_other_side(const HandEstimate& own);
  /// The pose of the mirrored hand when the verification ended (T_camera_segment).
  const HandPose& mirrored_pose() const { return *mirrored_->view().expected_pose; }

  /// Call with an observation in which a pose of the profile was found or tracked with `score`. Returns the size of the
  /// hand in view relative to a profile that is not fitted while tracking, if the detected joints show another size
  /// and a copy of that size explains the observation clearly better. Only the first frames of a track are used.
  std::optional<double> other_size_in_view(const HandObservation& observation, double score);
  /// Call when a new track starts, before other_size_in_view().
  void expect_any_size() { size_checks_ = 0; }

  /// Call when a search found no hand in an observation. After some of these calls, another size is tried, and reported
  /// if it fits. `score`: that of the best pose [m]; infinite if there was none.
  void nothing_found(const HandObservation& observation, double score);

 private:
  std::unique_ptr<HandTracker> tracker_of(HandProfile profile, Skin skin) const;
  std::unique_ptr<HandTracker> tracker_of_size(double size) const;
  HandTracker& other_side();
  // Searches with copies of the hand profile that are scaled by about exp(`log_size`). Returns the size of the best one
  // if it explains the observation clearly better than `score` [m].
  std::optional<double> verified_size(const HandObservation& observation, double score, double log_size);
  // The networks' log odds that a hand is one of the profile's side.
  double own_side_log_odds(const DetectedHand& hand) const;
  // Reports a hand of the other side, once.
  void report_other_side();

  TrackerParams params_;
  HandProfile profile_;
  std::shared_ptr<const Skin> skin_;
  std::uint64_t seed_;
  Workers& workers_;
  std::shared_ptr<spdlog::logger> log_;
  std::unique_ptr<HandTracker> mirrored_;
  HandEvidence other_side_evidence_;  // log odds of the other side against the profile's
  bool own_side_is_sure_ = false;     // whether the networks are sure, in this frame, of the profile's side
  std::uint32_t searched_frames_ = 0;
  bool side_reported_ = false, size_reported_ = false;
  int failures_ = 0, tries_ = 0;  // calls of nothing_found() with a hand-like region, and tries of another size
  int size_checks_ = 0;           // frames of this track whose detected joints were used
  int size_refuted_ = 0;          // number of deviating sizes that detected joints showed since one was confirmed
  std::optional<double> confirmed_size_;

  struct Verification {
    int frames = 0, compared = 0;          // number of all frames, and of those in which both sides were tracked
    double own_sum = 0, mirrored_sum = 0;  // sums of the scores of the `compared` frames [m]
    int detected = 0;                      // number of the frames in which the networks saw the hand
    double own_side = 0;                   // sum of their log odds that it is one of the profile's side
    HandEstimatePtr mirrored;
  };
  std::optional<Verification> verification_;
  // After a verification found the other side: number of successive searches that the profile's side must still win.
  int to_confirm_ = 0;
};

}  // namespace barehand
