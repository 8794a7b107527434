#pragma once

#include <vector>

#include "hand/surface.h"

namespace barehand {

/// The skin thinned to about one point per `spacing` x `spacing` [m], laid out for SIMD, plus a stub of forearm.
struct CoarseSkin {
  struct Part {
    int segment = 0;  ///< whose frame the points are in
    float width = 0;  ///< [m] side of the square of skin for which a point stands
    std::vector<float> x, y, z, nx, ny, nz;
    std::size_t size() const { return x.size(); }
  };
  std::vector<Part> parts;  ///< one for every segment
  /// Beginning of the forearm, in the palm's frame. A hand never ends in the air at its wrist: this tells the wrist
  /// from the fingers where the silhouette alone does not.
  Part forearm;
};

CoarseSkin make_coarse_skin(const HandProfile& profile, const HandSurface& surface, double spacing);

}  // namespace barehand
