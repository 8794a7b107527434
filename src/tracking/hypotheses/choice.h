#pragma once

#include <string_view>
#include <utility>

#include "hand/decision.h"
#include "observe/observation.h"
#include "tracking/hypotheses/hypothesis.h"

namespace barehand {

/// All thresholds on the global score by which the tracker prefers one explanation of the data to another. An advantage
/// is the fraction by which the challenger's score must be lower than that of the pose that it replaces.
struct ChoiceParams {
  // Advantages that other poses of a frame need over the followed one.
  double sampling_advantage = 0.02;
  bool uncross_fingers = true;
  double search_advantage = 0.1;

  // Absolute global scores [m].
  double sufficient_score = 0.0015;
  double confident_score = 0.002;

  // Multiples of the track's baseline score.
  double ambiguity_margin = 0.15;
  double confirmation_factor = 1.25;

  // These values say when a pose agrees with the detection.
  double agreement = 0.02;
  double detection_factor = 0.5;
  bool operator==(const ChoiceParams&) const = default;
};

template <class V>
void visit(V& v, ChoiceParams& p) {
  // These compare sampled and uncrossed poses with the followed one.
  v("sampling_advantage", p.sampling_advantage, 0.0, 1.0,
    "a sampled pose replaces the predicted one only if its global score is lower by this fraction");
  v.formerly("uncross");
  v("uncross_fingers", p.uncross_fingers, "also test the followed pose with crossing fingers put side by side");

  // These compare the poses that a search found with the followed one.
  v("search_advantage", p.search_advantage, 0.0, 1.0,
    "a pose found by a search replaces the followed one only if its global score is lower by this fraction");

  // These judge a score by itself.
  v.formerly("search_settled");
  v("sufficient_score", p.sufficient_score, 0.0, 0.1,
    "m, a found pose with a lower global score ends the search of a frame");
  v.formerly("search_convincing");
  v("confident_score", p.confident_score, 0.0, 0.1,
    "m, a pose with a lower global score is confident, whatever the baseline score");

  // These judge a score against the baseline score.
  v.formerly("doubt");
  v("ambiguity_margin", p.ambiguity_margin, 0.0, 1000.0,
    "a pose is ambiguous, and the frame is searched as well, if its score exceeds the baseline score by this fraction "
    "and it is not confident");
  v.formerly("unsure");
  v("confirmation_factor", p.confirmation_factor, 0.0, 1000.0,
    "a hand that returns with a score above this multiple of its baseline score must be confirmed by the next frame; "
    "0: never");

  // These set what a detection that confirms a pose does.
  v("agreement", p.agreement, 0.0, 1.0,
    "m, a detection confirms a pose if the mean distance between its joints and the pose's is at most this");
  v.formerly("confirmed");
  v("detection_factor", p.detection_factor, 0.0, 1.0,
    "factor on the score of a pose that a detection confirms; 1: no effect");

  // These were rules of which the ablation showed no effect.
  for (const char* key :
       {"different_pose_advantage", "elsewhere_advantage", "rejection_factor", "unlike", "uncross_allowance"})
    v.without_effect(key);
}

// A pose from detected joints replaces the followed one if their cost (joint_cost()) is below the first for it, so that
// the networks are about as wrong as usual, and lower by the second than for the followed pose.
inline constexpr double kTrustedJointCost = 1.2, kJointCostAdvantage = 0.05;

/// A pose in which fingers were exchanged for those of a second look needs this advantage, and a lower joint cost.
inline constexpr double kExchangeAdvantage = 0.05;

/// The pose with uncrossed fingers may have a score that is higher by up to this fraction: fingers side by side are
/// more likely a priori.
inline constexpr double kUncrossAllowance = 0.05;

// Advantages that one hypothesis about the hand (left or right, its size, its profile) needs over another one.
inline constexpr double kHandAdvantage = 0.1;  ///< advantage needed if a single frame is compared
/// Advantage needed to assign a region to one side while the other side's hand was just lost: a hand that reappears
/// half visible fits both sides.
inline constexpr double kReturningAdvantage = 0.3;
inline constexpr double kVerificationAdvantage = 0.2;  ///< advantage needed in the mean over a verification's frames
inline constexpr double kFarBetter = 0.3;              ///< advantage that is decisive in each of a few frames

/// Whether a score is lower than another one by more than the fraction `advantage`.
inline bool clearly_better(double score, double other, double advantage = kHandAdvantage) {
  return score < other * (1 - advantage);
}

/// Chooses between hypotheses and records the decisions of a frame.
class Choice {
 public:
  /// `params` must outlive the object.
  explicit Choice(const ChoiceParams& params) : params_(params) {}

  /// The global score [m] of a pose, reduced by the factor `detection_factor` if the detected joints agree with it.
  /// Refinement and detection make different errors, so a pose on which both agree may explain the frame worse than
  /// usual, for example because the skin model does not match the hand or the sensor.
  double score_with_detection(const HandObservation& observation, const HandProfile& profile,
                              const RefinedPose& refined) const;
  /// Whether the challenger replaces `present`; records the decision. `rule`: name of the rule, a static string.
  bool replaces(std::string_view rule, const Hypothesis& challenger, const Hypothesis& present, double advantage);
  /// Records a decision that was made by other code.
  void note(const Decision& decision) { decisions_.push_back(decision); }
  /// The decisions since the last call.
  Decisions take() { return std::exchange(decisions_, {}); }

 private:
  const ChoiceParams& params_;
  Decisions decisions_;
};

}  // namespace barehand
