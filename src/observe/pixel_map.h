#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "observe/observation.h"
#include "observe/pixel_rays.h"

namespace barehand {

/// The observation as the inner loop of the local trackers wants it: one look-up gives all of Eq. 1. The region of
/// interest with a border of one pixel, which stands for everything outside of it.
struct PixelMap {
  /// (x, y, |z|) [m]: nearest hand point; z > 0: this pixel is hand and the point its own; z < 0: it is not hand.
  /// Skin behind `occluder_z` is hidden by non-skin data (Sec. 4.2); -infinity: the pixel says nothing at all.
  struct Cell {
    float x, y, z, occluder_z;
  };
  int width = 0, height = 0;         ///< border included
  float fx = 0, fy = 0;              ///< [pixel]
  float cx = 0, cy = 0;              ///< principal point in coordinates of this map
  std::vector<Cell> cells;           ///< row-major
  std::vector<std::int32_t> hidden;  ///< bit s: hidden from segment s by the hand itself
  PixelRays rays;                    ///< of the region of interest, without the border

  std::size_t index(int u, int v) const { return static_cast<std::size_t>(v) * width + u; }
};

/// `missing_is_background`: a pixel without depth is not hand, as in the paper; otherwise it says nothing. What lies
/// outside the camera's image says nothing; what lies outside the region of interest only is not hand. `reused`: an
/// earlier map, whose memory the new one takes.
PixelMap make_pixel_map(const HandObservation& observation, bool missing_is_background, Workers& workers,
                        PixelMap reused = {});

}  // namespace barehand
