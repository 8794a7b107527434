#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "math/camera.h"
#include "math/disjoint_sets.h"

namespace barehand {

/// Clears the 8-connected parts of a mask that are smaller than half a fingertip. Reuses its memory.
class SpeckRemover {
 public:
  /// `depth` [m] must have the size of `mask`. The depth of a part is read at its centre of gravity; without a
  /// measurement there, half a metre is assumed.
  void remove(const Intrinsics& camera, const Image<float>& depth, Image<std::uint8_t>& mask);

 private:
  /// A run of set pixels in a row.
  struct Run {
    int v, begin, end;  // columns [begin, end)
  };
  struct Part {
    std::int64_t pixels = 0, sum_u = 0, sum_v = 0;
  };

  void find_runs(const Image<std::uint8_t>& mask);

  std::vector<Run> runs_;
  DisjointSets sets_;        // sets of runs, one per part
  std::vector<Part> parts_;  // indexed by the root run of a part
};

}  // namespace barehand
