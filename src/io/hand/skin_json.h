#pragma once

#include "hand/skin.h"
#include "io/hand/json_fields.h"

namespace barehand {

/// Reads the skin from the key "skin" of a hand profile (docs/formats.md); the skin has no normals yet. Errors name the
/// key and the entry: numbers that no hand has, segments that are not neighbours, triangles of vertices that do not
/// exist.
Result<Skin> skin_from_json(const json_fields::Json& json, const std::string& where);
/// Writes what skin_from_json() reads, rounded to 1e-6 m.
json_fields::Json skin_to_json(const Skin& skin);

}  // namespace barehand
