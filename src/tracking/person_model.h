#pragma once

#include <memory>
#include <optional>

#include "person/person_fit.h"
#include "person/person_scan.h"
#include "tracking/hand_model.h"
#include "tracking/hand_size_verifier.h"
#include "tracking/tracker_context.h"

namespace barehand {

/// The hand that is tracked, and what is learnt of its person meanwhile: a mean hand is fitted to the bones, skin that
/// was not scanned before is scanned, and the size of any other hand is checked. What is learnt counts from the next
/// frame on.
class PersonModel {
 public:
  /// `given`: the hand before anything is learnt.
  PersonModel(const TrackerContext& context, std::shared_ptr<const HandProfile> given);

  HandModel& hand() { return *model_; }
  /// As learnt so far.
  const HandProfile& profile() const { return *model_->profile; }
  const std::shared_ptr<const HandProfile>& shared_profile() const { return model_->profile; }
  /// Size of the hand in view relative to its profile, as far as that is known; 1: nothing speaks against it.
  double size_in_view() const { return size_in_view_; }

  /// The hand in view has `size` times the profile's size: reported once, and no pose is certain from now on.
  void doubt_size(double size);
  /// A track begins; it may be another person's.
  void start_track();
  /// Learns from a tracked frame. `good`: it is explained well enough to learn from.
  void learn(const HandObservation& observation, const RefinedPose& refined, bool good);
  /// Takes a scan that has ended meanwhile.
  void adopt_scan();
  /// Forgets the person.
  void reset();
  /// Continues with another given hand, of which nothing is learnt yet.
  void use(std::shared_ptr<const HandProfile> given);
  /// Continues with other parameters and another observer, which the context is to get next, with the person as
  /// learnt so far. May throw; then nothing has changed.
  void change(const TrackerParams& params, std::shared_ptr<Observer> observer);

 private:
  std::unique_ptr<HandModel> model_of(std::shared_ptr<const HandProfile> profile) const;
  void start_learning();
  void expect_any_size();
  void check_size(const HandObservation& observation, const RefinedPose& refined);
  void fit_bones(const HandObservation& observation, const HandPose& pose);

  const TrackerContext& context_;
  std::shared_ptr<const HandProfile> given_;
  std::unique_ptr<HandModel> model_;
  std::optional<PersonFit> fit_;                   // if the given hand is a mean hand
  std::unique_ptr<PersonScan> scan_;               // if its skin was not scanned before
  std::optional<HandSizeVerifier> size_verifier_;  // of a hand that is not fitted, or no longer
  double size_in_view_ = 1;
  bool said_size_ = false;
};

}  // namespace barehand
