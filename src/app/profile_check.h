#pragma once

#include <memory>
#include <optional>

#include "app/hand_tracker.h"

namespace barehand {

/// Whether a profile can be that of the hand in view, asked while it is searched for and in the first frames of a
/// doubtful start: a hand of the other side, a child's or a giant's may be bent to it or never be found. Looks with the
/// profile seen in a mirror and with smaller and larger copies, and says in the log what it sees.
class ProfileCheck {
 public:
  /// `workers` outlives it.
  ProfileCheck(const TrackerParams& params, const HandProfile& profile, std::uint64_t seed, Workers& workers,
               std::shared_ptr<spdlog::logger> log);

  /// A search of up to `attempts` found the hand with `score`: whether the mirrored profile, looked for in the same way
  /// if in fewer attempts, explains it clearly better. If that is not said and the score does not convince, a trial
  /// begins.
  bool is_other_side(const HandObservation& observation, Effort effort, int attempts, double score);

  /// A trial: the mirrored profile is tracked, too, in the frames after a start, from where it was `found` at best. A
  /// single frame seldom tells a hand from one of the other side that is bent to it; what moves does.
  void begin_trial(const HandObservation& observation, std::optional<HandTracker::Fit> found);
  void end_trial() { trial_.reset(); }
  bool on_trial() const { return trial_.has_value(); }
  /// The mirrored profile's part of one frame.
  void track_mirrored(const HandObservation& observation);
  /// After that and the profile's own part: whether the trial ends with the other side.
  bool turns_out_other_side(const HandEstimate& own);
  /// Where that ended: the hand of the other side (T_camera_segment).
  const HandPose& mirrored_pose() const { return *mirrored_->whereabouts(); }

  /// A search found no hand in what looks like one, at best with `score` (infinite: nothing at all). Now and then
  /// another size is tried.
  void nothing_found(const HandObservation& observation, double score);

 private:
  HandTracker tracker_of(const HandProfile& profile) const;
  HandTracker& other_side();
  void say_side();

  TrackerParams params_;
  HandProfile profile_;
  std::uint64_t seed_;
  Workers& workers_;
  std::shared_ptr<spdlog::logger> log_;
  std::unique_ptr<HandTracker> mirrored_;
  bool said_side_ = false, said_size_ = false;
  int failures_ = 0, tries_ = 0;

  struct Trial {
    int frames = 0, compared = 0;          // compared: both were tracked
    double own_sum = 0, mirrored_sum = 0;  // of their scores [m]
    HandEstimatePtr mirrored;
  };
  std::optional<Trial> trial_;
  int suspected_ = 0;  // searches that must still find the profile's own side, since a trial found the other one
};

}  // namespace barehand
