#pragma once

#include <cstdint>

#include "core/image.h"

namespace barehand {

/// Nearest occupied cells of a picture for a few of its cells: one cheap pass over all of them, then each question
/// costs as many steps as the answer is cells away.
class NearestCell {
 public:
  /// Cells with `occupied[i] >= 0`. At most 2^15 rows. Keeps its allocation from picture to picture.
  void index(const Image<std::int32_t>& occupied);
  /// Index of the occupied cell that is nearest to cell (u, v), exactly; of equally near ones always the same. -1 if
  /// none is occupied.
  std::int32_t find(int u, int v) const;

 private:
  Image<std::int16_t> row_;  // per cell: nearest occupied row of its column; kNone if the column is empty
};

}  // namespace barehand
