#pragma once

#include <string>

#include "core/error.h"
#include "hand/segments.h"

namespace barehand::synthetic {

/// The folder of the fetched hand meshes: `configured` if it is not empty, else $BAREHAND_HANDS, else
/// ${XDG_CACHE_HOME:-~/.cache}/barehand/hands, where deploy/fetch_hand_mesh.sh puts them.
std::string hand_mesh_folder(const std::string& configured = {});

/// Path of left.glb or right.glb in that folder. Error: the file does not exist; the remedy is the command that
/// fetches it.
Result<std::string> find_hand_mesh(Handedness handedness, const std::string& configured = {});

}  // namespace barehand::synthetic
