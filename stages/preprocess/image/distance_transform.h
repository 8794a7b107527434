#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"

namespace barehand {

/// The extended distance transform of the paper (Sec. 4.1, Fig. 4): for every pixel the index of a set pixel that is
/// nearest in the image plane. Exact Euclidean distance in linear time (Meijster et al. 2000); among equally near
/// pixels the choice is deterministic. -1 everywhere if no pixel is set.
class NearestPixelTransform {
 public:
  /// `mask`: non-zero = set. `nearest` gets the mask's size; index = v * width + u.
  void compute(const Image<std::uint8_t>& mask, Image<std::int32_t>& nearest);

 private:
  Image<std::int32_t> row_;           // per pixel: row of the nearest set pixel in its column; far outside if none
  std::vector<std::int32_t> column_;  // columns of the parabolas in the lower envelope of the current row
  std::vector<std::int32_t> from_;    // first column in which each of these parabolas is the lowest
};

}  // namespace barehand
