#pragma once

#include <span>

#include "object/known_object.h"

namespace barehand {

/// A surface with fewer samples than this (about 16 cm^2) is not made into a closed mesh.
inline constexpr std::size_t kFewestSamples = 100;

/// The closed surface of an object that was seen in parts.
struct ScannedMesh {
  ObjectMesh mesh;       ///< watertight, in the frame of the samples [m]; empty if too little was seen
  std::size_t lids = 0;  ///< index of the first triangle that closes an unseen part; the seen triangles precede it
  double seen = 0;       ///< fraction of the mesh's area that was seen
};

/// Makes a closed surface from samples of the surface that was seen (about one sample in each cell of 4 mm). Near the
/// samples, it is the weighted mean of their tangent planes, as in SurfaceDistance; elsewhere, it is where the winding
/// number of the samples (Barill et al. 2018) is one half. That closes unseen parts without bulges: a flat opening gets
/// a flat lid. Only the largest connected part is kept. `cell`: size of the triangles [m]; the computing time is
/// proportional to 1 / cell^3.
ScannedMesh scanned_mesh(std::span<const SurfaceSample> samples, double cell);

}  // namespace barehand
