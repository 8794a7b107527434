#pragma once

#include <memory>
#include <optional>
#include <stop_token>

#include "person/person_fit.h"
#include "person/person_scan.h"
#include "tracking/hand_model.h"
#include "tracking/hand_size_verifier.h"
#include "tracking/tracker_context.h"

namespace barehand {

/// The model of the tracked hand, which learns the person while tracking: the bones of a mean hand (the average of many
/// people) are fitted, a skin that was not scanned before is scanned, and the size of any other profile is checked.
/// What is learnt is used from the next frame on.
class PersonModel {
 public:
  /// `given`: the profile before anything is learnt; `skin`: its skin, or null, if it is still to be made. `context`
  /// must outlive this object.
  PersonModel(const TrackerContext& context, std::shared_ptr<const HandProfile> given,
              std::shared_ptr<const Skin> skin = nullptr);

  ~PersonModel() { stop_fit_.request_stop(); }
  PersonModel(const PersonModel&) = delete;
  PersonModel& operator=(const PersonModel&) = delete;

  HandModel& hand() { return *model_; }
  /// The profile as learnt so far.
  const HandProfile& profile() const { return *model_->profile; }
  const std::shared_ptr<const HandProfile>& shared_profile() const { return model_->profile; }
  const std::shared_ptr<const Skin>& shared_skin() const { return model_->skin; }
  /// Size of the hand in view relative to its profile; 1 unless another size was found.
  double size_in_view() const { return size_in_view_; }

  /// Notes that the hand in view seems to have `size` times the profile's size. This is reported to the user once, and
  /// the estimates state a larger uncertainty until the next track.
  void note_size_mismatch(double size);
  /// Must be called when a track begins, possibly that of another person.
  void start_track();
  /// Learns from a tracked frame. `good`: the frame is explained well enough to learn the bones and the skin from it.
  void learn(const HandObservation& observation, const RefinedPose& refined, bool good);
  /// If a scan has ended, continues with the scanned hand.
  void adopt_scan();
  /// Forgets what was learnt of the person.
  void reset();
  /// Continues with the profile of another person, of whom nothing is learnt yet.
  void use(std::shared_ptr<const HandProfile> given);
  /// Continues with other parameters and another observer, and keeps what was learnt of the person. Call before the
  /// context gets them. May throw; then nothing has changed.
  void change(const TrackerParams& params, std::shared_ptr<Observer> observer);

 private:
  std::unique_ptr<HandModel> model_of(std::shared_ptr<const HandProfile> profile,
                                      std::shared_ptr<const Skin> skin) const;
  void start_learning();
  void expect_any_size();
  void check_size(const HandObservation& observation, const RefinedPose& refined);
  void fit_bones(const HandObservation& observation, const HandPose& pose);

  const TrackerContext& context_;
  std::shared_ptr<const HandProfile> given_;
  std::shared_ptr<const Skin> given_skin_;
  std::unique_ptr<HandModel> model_;
  std::stop_source stop_fit_;                      // stops what `fit_` does in the background
  std::optional<PersonFit> fit_;                   // only if the given profile is a mean hand
  std::unique_ptr<PersonScan> scan_;               // only if the skin of the given profile was not scanned
  std::optional<HandSizeVerifier> size_verifier_;  // only while the profile is not being fitted
  double size_in_view_ = 1;
  bool size_reported_ = false;
};

}  // namespace barehand
