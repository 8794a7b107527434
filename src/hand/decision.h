#pragma once

#include <string_view>

#include "core/frame_memory.h"

namespace barehand {

/// One decision that a tracker took in a frame, for whoever asks why: which of two explanations of the data was
/// preferred, and by what. The names live as long as the process.
struct Decision {
  std::string_view rule;    ///< the rule that decided; docs/method.md lists them
  std::string_view winner;  ///< what was chosen: an origin of hypotheses, a side, or a phase of the track
  std::string_view loser;   ///< what was not; "" where nothing else was there
  double winner_score = 0;  ///< global score [m]; NaN: it has none
  double loser_score = 0;   ///< global score [m]; NaN: it has none
  double advantage = 0;     ///< fraction by which the challenger's score must be lower
};
using Decisions = FrameVector<Decision>;

}  // namespace barehand
