#pragma once

#include <cstdint>
#include <optional>

#include "core/parallel/delayed_result.h"
#include "tracking/hand_model.h"
#include "tracking/hypotheses/hypothesis.h"
#include "tracking/tracker_context.h"

namespace barehand {

/// Examines whether the joints that the networks see give a better pose than the followed one, of the whole hand or of
/// single fingers. Mostly they do not. It takes as long as several frames, and is done beside the tracking
/// (Workers::run_in_background). Not thread-safe.
class SecondOpinion {
 public:
  /// `context` must outlive the object.
  explicit SecondOpinion(const TrackerContext& context) : context_(context) {}

  /// Examines the second look (stages/detection/second_look.h) of frame number `frame`, if there is one, or, if the
  /// followed pose is `ambiguous`, the detected hand; but nothing while another one is examined. Returns the pose that
  /// was found in an earlier frame, moved with the palm of the followed pose since then; in that frame it explained the
  /// data no worse than the followed pose and agreed better with the joints. None in most frames.
  std::optional<HandPose> next(const HandObservation& observation, const HandModel& hand, const Hypothesis& followed,
                               bool ambiguous, std::uint32_t frame);
  /// Ignores what is being examined, since another hand is followed from now on.
  void forget() { better_.outdate(); }

 private:
  /// A pose that is better than the followed pose of the same frame.
  struct Better {
    HandPose pose, followed;
  };
  /// Whether the joints of a second look give such a pose; asked once.
  struct Question;

  const TrackerContext& context_;
  DelayedResult<std::optional<Better>> better_;
};

}  // namespace barehand
