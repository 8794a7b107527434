#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "math/camera.h"
#include "stages/preprocess/image/disjoint_sets.h"

namespace barehand {

/// Clears parts of a mask, joined through eight neighbours, that are smaller than half a fingertip. Keeps its
/// allocations.
class SpeckRemover {
 public:
  /// `depth` [m] of the same size; that of a part is read at its centre of gravity (half a metre if there is none).
  void remove(const Intrinsics& camera, const Image<float>& depth, Image<std::uint8_t>& mask);

 private:
  /// Neighbouring pixels of a row.
  struct Run {
    int v, begin, end;  // columns [begin, end)
  };
  struct Part {
    std::int64_t pixels = 0, sum_u = 0, sum_v = 0;
  };

  void find_runs(const Image<std::uint8_t>& mask);

  std::vector<Run> runs_;
  DisjointSets sets_;        // of runs: one a part
  std::vector<Part> parts_;  // at their roots
};

}  // namespace barehand
