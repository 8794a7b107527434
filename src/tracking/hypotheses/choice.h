#pragma once

#include <string_view>
#include <utility>

#include "hand/decision.h"
#include "observe/observation.h"
#include "tracking/hypotheses/hypothesis.h"

namespace barehand {

/// Every threshold on the global score by which the tracker prefers one explanation of the data to another, side by
/// side. An advantage is the fraction by which the challenger's score must be lower than that of what it replaces.
struct ChoiceParams {
  // Challengers of the followed pose, in one frame.
  double sampling_advantage = 0.02;  ///< of the sampled pose
  bool uncross = true;               ///< whether fingers that cross are put side by side
  double uncross_allowance = 0.05;   ///< fraction by which the score may then be higher
  double search_advantage = 0.1;     ///< of a pose that was found anew, with the palm where it is
  double elsewhere_advantage = 0.3;  ///< of a pose that was found anew elsewhere

  // Absolute levels.
  double search_settled = 0.0015;    ///< [m] a found pose below ends the searches of a frame
  double search_convincing = 0.002;  ///< [m] a pose below is confident, whatever the baseline

  // Multiples of the track's baseline score.
  double doubt = 0.15;   ///< above (1 + doubt) times the baseline the followed pose is ambiguous
  double unsure = 1.25;  ///< above, a hand that returns must be confirmed by the next frame; 0: never
  double unlike = 2;     ///< above, what is found instead of a lost hand is not that hand; 0: it always may be

  // Agreement with the detection.
  double agreement = 0.02;  ///< [m] mean distance of the joints, within which a detection confirms a pose
  double confirmed = 0.5;   ///< factor of the score of a confirmed pose; 1: a detection confirms nothing
  bool operator==(const ChoiceParams&) const = default;
};

template <class V>
void visit(V& v, ChoiceParams& p) {
  v("sampling_advantage", p.sampling_advantage, 0.0, 1.0,
    "a sampled pose replaces the predicted one only if its global score is lower by this fraction");
  v("uncross", p.uncross, "put fingers that cross side by side, where that explains the frame about as well");
  v("uncross_allowance", p.uncross_allowance, 0.0, 1.0, "by this fraction the global score may then be higher");
  v("search_advantage", p.search_advantage, 0.0, 1.0,
    "a pose found by a search replaces the followed one only if its global score is lower by this fraction");
  v("elsewhere_advantage", p.elsewhere_advantage, 0.0, 1.0,
    "the same for a found pose whose palm lies elsewhere than that of the followed one");
  v("search_settled", p.search_settled, 0.0, 0.1,
    "m, a found pose with a lower global score ends the searches of a frame");
  v("search_convincing", p.search_convincing, 0.0, 0.1, "m, a found pose with a lower global score convinces");
  v("doubt", p.doubt, 0.0, 1000.0,
    "a frame whose score is higher than usual by this fraction, and not convincing, is searched beside the tracking");
  v("unsure", p.unsure, 0.0, 1000.0,
    "a hand that returns with so many times its usual score must be confirmed by the next frame; 0: never");
  v("unlike", p.unlike, 0.0, 1000.0,
    "with so many times the usual score, and not convincing, it is not the hand that was lost; 0: it always may be");
  v("agreement", p.agreement, 0.0, 1.0, "m, a detection whose joints lie so near on average confirms a pose");
  v("confirmed", p.confirmed, 0.0, 1.0, "factor of the score of a confirmed pose; 1: a detection confirms nothing");
}

/// Advantages of a side or a size of the hand over another one.
inline constexpr double kHandAdvantage = 0.1;       ///< in one frame
inline constexpr double kReturningAdvantage = 0.3;  ///< over a hand that was lost a moment ago: half of it fits both
inline constexpr double kTrialAdvantage = 0.2;      ///< over all frames of a trial
inline constexpr double kFarBetter = 0.3;           ///< in every one of a few frames

/// Whether a score is lower than another one by the fraction `advantage`.
inline bool clearly_better(double score, double other, double advantage = kHandAdvantage) {
  return score < other * (1 - advantage);
}

/// Chooses between hypotheses and keeps what was decided in this frame.
class Choice {
 public:
  /// `params` outlives it.
  explicit Choice(const ChoiceParams& params) : params_(params) {}

  /// The score of a pose in the light of the detection. Refinement and detection err in different ways: where they
  /// agree, the frame may be explained worse, as with a sensor or a hand that the skin model knows badly.
  double judged_score(const HandObservation& observation, const HandProfile& profile, const RefinedPose& refined) const;
  /// Whether the challenger takes the place of `present`. `rule`: a name that lives as long as the process.
  bool replaces(std::string_view rule, const Hypothesis& challenger, const Hypothesis& present, double advantage);
  /// Adds a decision that was taken elsewhere.
  void note(const Decision& decision) { decisions_.push_back(decision); }
  /// The decisions since the last call.
  Decisions take() { return std::exchange(decisions_, {}); }

 private:
  const ChoiceParams& params_;
  Decisions decisions_;
};

}  // namespace barehand
