#pragma once

#include <string>

#include "core/error.h"
#include "object/object_mesh.h"

namespace barehand {

/// The unit of the numbers in a file of a mesh.
enum class LengthUnit { metre, centimetre, millimetre };
/// Error: the name is not m, cm or mm.
Result<LengthUnit> unit_from(const std::string& name);

/// A mesh as read, and what had to be repaired.
struct LoadedMesh {
  ObjectMesh mesh;
  MeshRepair repair;
};

/// Reads an object's closed surface from an OBJ, PLY, STL or glTF file (any that assimp knows), in metres and in the
/// file's own frame. Its name is that of the file without folder and extension. Errors: a file that cannot be read, is
/// empty or not finite, an object that is too small or too large to be held, probably because of a wrong unit, and what
/// repair_mesh() cannot repair.
Result<LoadedMesh> load_mesh(const std::string& path, LengthUnit unit);

}  // namespace barehand
