#pragma once

#include <algorithm>
#include <vector>

#include "core/image.h"

namespace barehand {

/// Sums over square windows; pixels outside the image count as zero.
template <typename T>
class WindowSum {
 public:
  /// Computes for every pixel of `in` the sum over the pixels at most `radius` columns and rows away. They are always
  /// added in the same order; a running sum would keep rounding errors of pixels that have left the window.
  template <typename In>
  void compute(const Image<In>& in, int radius, Image<T>& out) {
    const int width = in.width(), height = in.height();
    out.reset(width, height);
    padded_.assign(width + 2 * radius, T{});
    for (int v = 0; v < height; ++v) {
      // Add up the rows of the window, which gives one sum for each column.
      T* column_sum = padded_.data() + radius;
      std::fill_n(column_sum, width, T{});
      for (int y = std::max(0, v - radius); y <= std::min(height - 1, v + radius); ++y) {
        const In* row = in.row(y);
        for (int u = 0; u < width; ++u) column_sum[u] = static_cast<T>(column_sum[u] + row[u]);
      }

      // Add up these sums over the width of the window.
      T* sum = out.row(v);
      for (int k = 0; k <= 2 * radius; ++k)
        for (int u = 0; u < width; ++u) sum[u] = static_cast<T>(sum[u] + padded_[u + k]);
    }
  }

 private:
  std::vector<T> padded_;  // sums of the columns over the rows of a window, with a margin of zeros
};

}  // namespace barehand
