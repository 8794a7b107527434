#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "evaluation/distribution.h"
#include "math/se3.h"
#include "object/object_mesh.h"

namespace barehand {

// Compares the stated poses of a known object with the truth.

/// T_camera_object by the time of the frame [us].
using ObjectPoses = std::map<std::int64_t, SE3>;

/// The truth about one object.
struct ObjectTruthTable {
  std::string name;
  ObjectPoses poses;
};
/// Reads a table of object poses (docs/formats.md). Errors name the line: a malformed number, another object.
Result<ObjectTruthTable> read_object_truth(const std::string& path);

/// Stated against true poses of one object.
struct ObjectEvaluation {
  std::string name;
  std::size_t frames = 0;  ///< number of frames in the truth
  std::size_t stated = 0;  ///< number of frames with a stated pose
  std::size_t lost = 0;    ///< number of frames without a stated pose, after the first one
  Distribution position;   ///< distance of the origins [m]
  Distribution rotation;   ///< angle between the orientations [rad]
  Distribution surface;    ///< mean distance of the stated surface's points from the true surface [m], as ADD-S
};

/// Compares over the frames of the truth. Error: no frame has both poses.
Result<ObjectEvaluation> evaluate_object(const ObjectTruthTable& truth, const ObjectPoses& stated,
                                         const ObjectMesh& mesh);

}  // namespace barehand
