#pragma once

#include "hand/skin.h"
#include "io/json_fields.h"

namespace barehand {

/// The key "skin" of a hand profile (docs/formats.md), without normals. Errors name key and entry: numbers that no hand
/// has, segments that are no neighbours, triangles of vertices that do not exist.
Result<Skin> skin_from_json(const json_fields::Json& json, const std::string& where);
/// What skin_from_json reads, to 1e-6 m.
json_fields::Json skin_to_json(const Skin& skin);

}  // namespace barehand
