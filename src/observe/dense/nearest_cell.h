#pragma once

#include <cstdint>

#include "core/image.h"

namespace barehand {

/// Finds the nearest occupied cell of an image for a few query cells. index() makes two cheap passes over all cells;
/// each query then takes as many steps as its result is cells away.
class NearestCell {
 public:
  /// Indexes the cells with `occupied[i] >= 0`; at most 2^15 rows. The buffer keeps its allocation from call to call.
  void index(const Image<std::int32_t>& occupied);
  /// Index of the occupied cell that is exactly nearest to cell (u, v); ties are resolved deterministically. -1 if no
  /// cell is occupied.
  std::int32_t find(int u, int v) const;

 private:
  Image<std::int16_t> row_;  // per cell: the nearest occupied row in its column; kNone if the column is empty
};

}  // namespace barehand
