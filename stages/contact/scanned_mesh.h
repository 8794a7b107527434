#pragma once

#include <span>

#include "object/known_object.h"

namespace barehand {

/// Fewer samples of a surface than this (about 16 cm^2) make no solid.
inline constexpr std::size_t kFewestSamples = 100;

/// The closed surface of an object that was seen in parts.
struct ScannedMesh {
  ObjectMesh mesh;       ///< watertight, in the frame of the samples [m]; empty if nothing solid was seen
  std::size_t lids = 0;  ///< the first of the triangles that close what was not seen, which are the last ones
  double seen = 0;       ///< fraction of its area that was seen
};

/// Lays a closed surface around samples of a surface, about one in each cell of 4 mm. Near the samples it is the
/// weighted mean of their planes, as in SurfaceDistance; elsewhere, the place where their winding number (Barill et al.
/// 2018) is one half. That closes what was not seen without bulges: a flat opening gets a flat lid. Only the largest
/// part is kept. `cell`: size of its triangles [m]; time grows with its inverse cubed.
ScannedMesh scanned_mesh(std::span<const SurfaceSample> samples, double cell);

}  // namespace barehand
