#pragma once

#include <string_view>

#include "core/memory/frame_memory.h"

namespace barehand {

/// One decision of a tracker in a frame, recorded to explain its result: which of two alternatives was preferred, by
/// which rule, and with which scores. The names must be static strings.
struct Decision {
  std::string_view rule;    ///< the rule that decided; docs/method.md lists them
  std::string_view winner;  ///< what was chosen: an origin of hypotheses, a side, or a phase of the track
  std::string_view loser;   ///< the rejected alternative; "" if there was none
  double winner_score = 0;  ///< global score of the winner [m]; NaN if it has none
  double loser_score = 0;   ///< global score of the loser [m]; NaN if it has none
  double advantage = 0;     ///< fraction by which a challenger's score must be lower to win
};
using Decisions = FrameVector<Decision>;

}  // namespace barehand
