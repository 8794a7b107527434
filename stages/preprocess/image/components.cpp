#include "stages/preprocess/image/components.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

// Splits cells into connected surfaces, and finds the cells that may be skin.

bool joined(const CoarseGrid& grid, float a, float b) {
  return std::abs(a - b) < same_surface_step(std::min(a, b), static_cast<float>(grid.camera.fx));
}

}  // namespace

void split_surfaces(const CoarseGrid& grid, const Image<std::uint8_t>& mask, Components& out) {
  const int width = mask.width(), height = mask.height();
  out.id.reset(width, height, -1);
  out.sets.clear();
  const int du[4] = {-1, -1, 0, 1}, dv[4] = {0, -1, -1, -1};

  // Visit the cells that belong to the mask.
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      if (!mask.at(u, v)) continue;

      // Join the cell with its neighbours to the left and above, if they are on the same surface.
      std::int32_t own = -1;
      for (int k = 0; k < 4; ++k) {
        const int nu = u + du[k], nv = v + dv[k];
        if (!mask.contains(nu, nv) || !mask.at(nu, nv) || !joined(grid, grid.z.at(u, v), grid.z.at(nu, nv))) continue;
        const std::int32_t other = out.id.at(nu, nv);
        own = out.sets.join(own < 0 ? other : own, other);
      }

      if (own < 0) own = out.sets.add();
      out.id.at(u, v) = own;
    }

  // Number the surfaces in the order of their first cells.
  out.part_of_root.assign(out.sets.size(), -1);
  out.parts.clear();

  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      if (out.id.at(u, v) < 0) continue;
      std::int32_t& i = out.part_of_root[out.sets.root(out.id.at(u, v))];
      if (i < 0) {
        i = static_cast<std::int32_t>(out.parts.size());
        out.parts.emplace_back();
      }
      out.id.at(u, v) = i;

      // Add the cell to its surface.
      Components::Part& part = out.parts[i];
      const Eigen::Vector3f p = grid.point(u, v);
      ++part.cells;
      part.area += grid.cell_area(p.z());
      part.centre += p;
    }

  // Divide the sums by the number of cells.
  for (Components::Part& part : out.parts) {
    part.centre /= static_cast<float>(part.cells);
    part.mean_z = part.centre.z();
  }
}

void CandidateFinder::find(const CoarseGrid& grid, const PreprocessParams& params, Image<std::uint8_t>& mask) {
  const float skin = static_cast<float>(params.skin_odds), other = -static_cast<float>(params.other_odds);
  evidence_.reset(grid.z.width(), grid.z.height(), Evidence::none);
  for (std::size_t i = 0; i < evidence_.size(); ++i) {
    if (grid.z[i] <= 0) continue;
    evidence_[i] = !grid.coloured || grid.odds[i] > skin ? Evidence::hand
                   : grid.odds[i] < other                ? Evidence::other
                                                         : Evidence::open;
  }

  // Decide the open cells by their neighbours on the same surface.
  if (grid.coloured)
    flood_.run(evidence_, grid.colour,
               [&](std::int32_t i, std::int32_t j) { return joined(grid, grid.z[i], grid.z[j]); });

  mask.reset(grid.z.width(), grid.z.height());
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = evidence_[i] == Evidence::hand;
}

}  // namespace barehand
