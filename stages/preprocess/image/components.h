#pragma once

#include <cstdint>
#include <vector>

#include "math/disjoint_sets.h"
#include "stages/preprocess/coarse_grid.h"
#include "stages/preprocess/image/flood.h"

namespace barehand {

// Splits cells of the coarse grid into connected surfaces.

/// Surfaces of the coarse grid: sets of cells joined through neighbours without a depth step.
struct Components {
  struct Part {
    int cells = 0;
    float area = 0;    ///< area, as if it faced the camera [m^2]
    float mean_z = 0;  ///< mean depth [m]
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  };
  Image<std::int32_t> id;                  ///< index into parts; -1 where the mask is empty
  std::vector<Part> parts;                 ///< in row-major order of their first cell
  DisjointSets sets;                       ///< scratch
  std::vector<std::int32_t> part_of_root;  ///< scratch
};

/// Splits the cells of `mask` (non-zero, with depth) into components. Reuses the allocations of `out`.
void split_surfaces(const CoarseGrid& grid, const Image<std::uint8_t>& mask, Components& out);

/// Finds the cells that may be skin. Cells with clear colours are decided by their own colour; others (dark,
/// overexposed, pale or without colour) by the clear cells to which they are joined without a depth step. Without
/// colour, all cells with depth are candidates.
class CandidateFinder {
 public:
  void find(const CoarseGrid& grid, const PreprocessParams& params, Image<std::uint8_t>& mask);

 private:
  Image<Evidence> evidence_;
  Flood flood_;
};

}  // namespace barehand
