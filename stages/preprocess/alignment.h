#pragma once

#include <memory>
#include <optional>

#include "stages/preprocess/coarse_grid.h"
#include "stages/preprocess/predicted_hand.h"

namespace barehand {

/// Finds the translation that moves a hand of an earlier frame onto the candidate cells of this frame. Reuses its
/// memory.
class TranslationSearch {
 public:
  TranslationSearch();
  ~TranslationSearch();

  /// Returns the translation [m] of `hand` onto the candidates (`mask` non-zero). In the image plane, the search is
  /// exhaustive up to a motion of `reach` [m] in blocks of cells, then in ever finer steps around the best shift; the
  /// motion in depth is a median. Candidates on the forearm's side of the wrist have no weight, so that neither a bare
  /// nor a clothed arm affects the result. None if the hand fits nowhere, so that the prediction is useless.
  std::optional<Eigen::Vector3f> find(const PredictedHand& hand, const CoarseGrid& grid,
                                      const Image<std::uint8_t>& mask, double reach);

 private:
  struct Buffers;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace barehand
