#pragma once

#include <cstdint>
#include <vector>

#include "stages/preprocess/coarse_grid.h"

namespace barehand {

/// Surfaces of the coarse grid: sets of cells joined through neighbours without a depth step.
struct Components {
  struct Part {
    int cells = 0;
    float area = 0;     ///< [m^2] facing the camera
    float nearest = 0;  ///< smallest z [m]
    float mean_z = 0;   ///< [m]
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  };
  Image<std::int32_t> id;   ///< index into parts; -1 where the mask is empty
  std::vector<Part> parts;  ///< in row-major order of their first cell
};

/// Splits the cells of `mask` (non-zero, with depth) into components. Reuses the allocations of `out`.
void split_surfaces(const CoarseGrid& grid, const Image<std::uint8_t>& mask, Components& out);

/// Which cells may be skin: by their own colour where it is clear, else by the clear cell they are joined to through
/// neighbours without a depth step (dark, overexposed or missing colour). Everything measured if there is no colour.
void skin_cells(const CoarseGrid& grid, float threshold, std::vector<std::int32_t>& queue, Image<std::uint8_t>& mask);

}  // namespace barehand
