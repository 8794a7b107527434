#pragma once

#include <optional>
#include <vector>

#include "tracking/hand_model.h"
#include "tracking/hypotheses/choice.h"
#include "tracking/hypotheses/hypothesis.h"
#include "tracking/hypotheses/second_opinion.h"
#include "tracking/track.h"
#include "tracking/tracker_context.h"

namespace barehand {

/// Makes hypotheses that do not continue the track, each refined and scored. (Not to be confused with Proposals, the
/// boxes from which samples are drawn.)
class Proposers {
 public:
  /// Both arguments must outlive the object.
  Proposers(const TrackerContext& context, Choice& choice)
      : context_(context), choice_(choice), second_opinion_(context) {}

  /// Returns the best pose of up to `attempts` searches of the whole observation. It stops early if further searches
  /// would not help (RestartConsensus), and does not search at all if the detected hand is explained well. None: too
  /// little of a hand is visible, nothing is found, or the detection may not be a hand. `frame`, the number of the
  /// frame, keys the random numbers.
  std::optional<Hypothesis> search_frame(const HandObservation& observation, const HandModel& hand, Track& track,
                                         Effort effort, int attempts, std::uint32_t frame) const;

  /// Returns an alternative to a followed pose that is tentative or ambiguous. Ambiguous means that the pose explains
  /// the frame clearly worse than this hand is usually explained. None: the pose is neither, it is not the turn of a
  /// search in this frame, or nothing is found.
  std::optional<Hypothesis> propose_alternative(const HandObservation& observation, const HandModel& hand, Track& track,
                                                const Hypothesis& followed, std::uint32_t frame) const;

  /// Replaces the followed pose by what the networks see (SecondOpinion), if something of it was examined and it
  /// explains the frame no worse. Fingers that were lost, or taken for their hidden neighbours, get their places back
  /// in this way.
  void look_again(const HandObservation& observation, const HandModel& hand, const Track& track, Hypothesis& followed,
                  std::uint32_t frame);

  /// Call when a track begins.
  void start_track() { second_opinion_.forget(); }

  /// Puts crossed fingers of the followed pose side by side if that explains the frame about as well.
  void uncross_fingers(const HandObservation& observation, const HandModel& hand, Hypothesis& followed) const;

 private:
  std::optional<Hypothesis> detected(const HandObservation& observation, const HandModel& hand) const;
  // One search of the whole observation. `attempt`: number of the search in this frame, from 0.
  std::optional<Hypothesis> search_once(const HandObservation& observation, const HandModel& hand, const Track& track,
                                        Effort effort, int attempt, std::uint32_t frame) const;
  // A search of the finger poses; the palm of `followed` must be about right.
  std::optional<Hypothesis> search_near(const HandObservation& observation, const HandModel& hand,
                                        const HandPose& followed, std::uint32_t frame) const;
  // Refines the first `search_refined` start poses by `iterations` steps each and returns the best one.
  std::optional<Hypothesis> best_of(Origin origin, const HandObservation& observation, const HandModel& hand,
                                    const std::vector<StartCandidate>& starts, int iterations) const;
  void set_neutral_joints(const HandObservation& observation, const HandModel& hand,
                          std::optional<Hypothesis>& found) const;

  const TrackerContext& context_;
  Choice& choice_;
  SecondOpinion second_opinion_;
};

}  // namespace barehand
