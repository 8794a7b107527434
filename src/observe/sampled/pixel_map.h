#pragma once

#include <cstdint>
#include <vector>

#include "core/parallel/parallel.h"
#include "observe/dense/pixel_rays.h"
#include "observe/observation.h"

namespace barehand {

/// The observation in the form that the inner loop of the local trackers needs: one look-up yields everything that the
/// paper's Eq. 1 depends on. It covers the region of interest plus a border of one pixel that represents everything
/// outside.
struct PixelMap {
  /// (x, y, |z|) is the nearest hand point in the camera frame [m]. z > 0: the pixel itself is hand and this is its own
  /// point; z < 0: the pixel is not hand. Skin behind the depth `occluder_z` [m] is hidden by data that is not skin
  /// (paper, Sec. 4.2); -infinity: the pixel gives no evidence.
  struct Cell {
    float x, y, z, occluder_z;
  };
  int width = 0, height = 0;         ///< size of the map, including the border [pixel]
  float fx = 0, fy = 0;              ///< focal lengths of the camera [pixel]
  float cx = 0, cy = 0;              ///< principal point in coordinates of this map [pixel]
  std::vector<Cell> cells;           ///< one cell per pixel, row by row
  std::vector<std::int32_t> hidden;  ///< bit s: another part of the hand hides segment s here
  PixelRays rays;                    ///< rays of the region of interest, without the border

  std::size_t index(int u, int v) const { return static_cast<std::size_t>(v) * width + u; }
};

/// Builds the map of an observation. `missing_is_background`: a pixel without depth counts as not hand, as in the
/// paper; otherwise it gives no evidence. Pixels outside the camera's image give no evidence; pixels in the image but
/// outside the region of interest are not hand. `reused`: an earlier map whose memory the new one takes over.
PixelMap make_pixel_map(const HandObservation& observation, bool missing_is_background, Workers& workers,
                        PixelMap reused = {});

}  // namespace barehand
