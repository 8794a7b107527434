#pragma once

#include <vector>

#include "hand/surface.h"

namespace barehand {

/// The skin thinned to about one point per `spacing` x `spacing` [m], laid out for SIMD, plus a stub of forearm.
struct CoarseSkin {
  struct Part {
    int segment = 0;  ///< the points are in the frame of this segment
    float width = 0;  ///< side length of the square of skin that one point represents [m]
    std::vector<float> x, y, z, nx, ny, nz;
    std::size_t size() const { return x.size(); }
  };
  std::vector<Part> parts;  ///< skin points of every segment
  /// Beginning of the forearm, in the palm's frame. A hand never ends at its wrist, so the forearm distinguishes the
  /// wrist from the fingers if the silhouette alone does not.
  Part forearm;
};

CoarseSkin make_coarse_skin(const HandProfile& profile, const HandSurface& surface, double spacing);

}  // namespace barehand
