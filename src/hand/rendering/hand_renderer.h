#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "hand/skin.h"
#include "math/camera.h"

namespace barehand {

// A renderer for the skin of a posed hand, which gives the depth and the nearest vertex of each cell.

/// Every `stride`-th pixel of a rectangle of the camera image: cell (i, j) is pixel (u0 + i stride, v0 + j stride).
struct CellGrid {
  int u0 = 0, v0 = 0, stride = 1, width = 0, height = 0;
};

/// A posed skin as the camera sees it at the cells of a grid. The buffers keep their allocation from call to call.
struct RenderedHand {
  CellGrid grid;
  Image<float> depth;          ///< z of the front-most skin [m]; 0 = no skin
  Image<std::int32_t> vertex;  ///< skin vertex with the largest barycentric weight in the cell; -1 = no skin
  std::vector<Eigen::Vector3f> position, normal;  ///< of every skin vertex, camera frame [m]; normals may be left out
  std::vector<Eigen::Array4f> in_grid;            ///< cell i, j, 1/z [1/m] and z [m] of every skin vertex
  /// Cells covered by the segment's camera-facing skin, hidden or not, in the grid or beyond the border of the image.
  std::array<int, kSegmentCount> projected{};
  std::array<float, kSegmentCount> beyond{};  ///< those of `projected` that lie beyond the border of the image
};

/// Whether render_hand() computes the normals, which are not needed for a score.
enum class Normals { computed, left_out };

/// Renders the triangles of `skin` that face the camera into a z-buffer (paper Sec. 4.1, "rendered into a depth
/// image").
void render_hand(const Skin& skin, const HandPose& pose, const Intrinsics& camera, const CellGrid& grid,
                 RenderedHand& out, Normals normals = Normals::computed);

}  // namespace barehand
