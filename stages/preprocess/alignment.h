#pragma once

#include <memory>
#include <optional>

#include "stages/preprocess/coarse_grid.h"
#include "stages/preprocess/predicted_hand.h"

namespace barehand {

/// Lays an older hand over the candidate cells of this frame. Keeps its allocations.
class TranslationSearch {
 public:
  TranslationSearch();
  ~TranslationSearch();

  /// The translation [m] to candidates (`mask` non-zero). Exhaustive in the image plane up to `reach` [m] of motion in
  /// blocks of cells, then in ever finer steps around the best; the depth follows as a median. The forearm's side of
  /// the wrist counts neither for nor against, so a bare or unclothed arm does not drag the hand along. None if no
  /// place explains the mask: the prediction is useless then.
  std::optional<Eigen::Vector3f> find(const PredictedHand& hand, const CoarseGrid& grid,
                                      const Image<std::uint8_t>& mask, double reach);

 private:
  struct Buffers;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace barehand
