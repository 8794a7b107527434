#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "core/error.h"

namespace barehand {

/// A name for the triangles from `first` on, as far as the next group.
struct ObjGroup {
  std::string name;
  std::size_t first = 0;
};

/// Writes a mesh as a Wavefront OBJ file, vertices in metres; an existing file is replaced. Vertices at the
/// same place become one, so that a surface whose vertices are doubled at its edges is written closed; triangles that
/// lose their area by this are left out. Errors: a full disk, a folder that cannot be written to.
Result<void> save_obj(std::span<const Eigen::Vector3f> vertices,
                      std::span<const std::array<std::uint32_t, 3>> triangles, const std::string& path,
                      std::span<const ObjGroup> groups = {});

}  // namespace barehand
