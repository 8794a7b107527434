#pragma once

#include <optional>
#include <vector>

#include "tracking/hand_model.h"
#include "tracking/hypotheses/choice.h"
#include "tracking/hypotheses/hypothesis.h"
#include "tracking/track.h"
#include "tracking/tracker_context.h"

namespace barehand {

/// Proposes poses that do not continue the track, each refined and scored.
class Proposers {
 public:
  /// Both outlive it.
  Proposers(const TrackerContext& context, Choice& choice) : context_(context), choice_(choice) {}

  /// The best pose of up to `attempts` searches of the whole observation; fewer do where they settle it
  /// (RestartConsensus), none is needed where the detected hand is explained well. None: too little of a hand is seen,
  /// nothing is found, or what is detected may be something else than a hand. `frame`, the number of the frame, keys
  /// the random numbers.
  std::optional<Hypothesis> anywhere(const HandObservation& observation, const HandModel& hand, Track& track,
                                     Effort effort, int attempts, std::uint32_t frame) const;

  /// A pose beside a followed one that explains the frame, where that is tentative or ambiguous, which means that it
  /// is explained clearly worse than this hand usually is. None: there is no doubt, or nothing is tried in this frame.
  std::optional<Hypothesis> beside(const HandObservation& observation, const HandModel& hand, Track& track,
                                   const Hypothesis& followed, std::uint32_t frame) const;

  /// Puts crossed fingers of the followed pose side by side if that explains the frame about as well.
  void uncross(const HandObservation& observation, const HandModel& hand, Hypothesis& followed) const;

 private:
  std::optional<Hypothesis> detected(const HandObservation& observation, const HandModel& hand) const;
  // One search of the whole observation; `attempt` counts those of a frame.
  std::optional<Hypothesis> searched(const HandObservation& observation, const HandModel& hand, const Track& track,
                                     Effort effort, int attempt, std::uint32_t frame) const;
  // A search of the fingers, near a pose whose palm is about right.
  std::optional<Hypothesis> near(const HandObservation& observation, const HandModel& hand, const HandPose& followed,
                                 std::uint32_t frame) const;
  // The best of the first start poses after so many refinement steps.
  std::optional<Hypothesis> best_of(Origin origin, const HandObservation& observation, const HandModel& hand,
                                    const std::vector<StartCandidate>& starts, int iterations) const;
  void relax(const HandObservation& observation, const HandModel& hand, std::optional<Hypothesis>& found) const;

  const TrackerContext& context_;
  Choice& choice_;
};

}  // namespace barehand
