#pragma once

#include <string>

namespace barehand {

/// How many levels of objects and arrays are nested in the JSON of a glTF file (.gltf, or .glb, which is binary); 0 for
/// files of other names and for files that cannot be read.
int gltf_depth(const std::string& path);

}  // namespace barehand
