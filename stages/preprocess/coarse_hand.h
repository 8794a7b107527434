#pragma once

#include <optional>

#include "observe/detection.h"
#include "stages/preprocess/predicted_hand.h"
#include "stages/preprocess/wrist.h"

namespace barehand {

class StandingDepth;

/// One hand in the coarse grid.
struct CoarseHand {
  bool found = false;
  bool followed = false;                    ///< whether it was found where the feedback predicts it
  Image<std::uint8_t> cells;                ///< 1 = hand
  std::optional<PredictedHand> prediction;  ///< the feedback, moved to where the hand is now; none if that fails
  Image<float> distance;            ///< distance of candidates from the prediction's skin [m]; infinite far away
  std::optional<WristPlane> wrist;  ///< plane behind which cells are forearm
  const StandingDepth* standing = nullptr;    ///< what stood there before and is left out; null if nothing is
  bool labelled = false;                      ///< whether labels of `detected` tell which pixels are not hand
  const DetectedHand* detected = nullptr;     ///< the corresponding detected hand; null if there is none
  const DetectedHand* second_look = nullptr;  ///< Detection::second_look, if it is of this hand
};

}  // namespace barehand
