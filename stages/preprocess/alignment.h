#pragma once

#include <optional>

#include "stages/preprocess/coarse_grid.h"
#include "stages/preprocess/predicted_hand.h"

namespace barehand {

/// The translation [m] that lays an older hand over the candidate cells (`mask` non-zero) of this frame. Exhaustive in
/// the image plane up to `reach` [m] of motion, first in blocks of cells, then in cells; the depth follows as a median.
/// The forearm's side of the wrist counts neither for nor against, so a bare or unclothed arm does not drag the hand
/// along. None if no place explains the mask: the prediction is useless then.
std::optional<Eigen::Vector3f> align_translation(const PredictedHand& hand, const CoarseGrid& grid,
                                                 const Image<std::uint8_t>& mask, double reach);

}  // namespace barehand
