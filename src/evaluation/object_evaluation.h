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

/// A half turn about a principal axis is a symmetry that nobody could see if it moves the surface by less than this in
/// the mean [m].
inline constexpr double kSameSurfaceTurned = 0.0005;

/// Stated against true poses of one object. A pose is compared as if it were turned by the symmetry with which its
/// rotation errs least.
struct ObjectEvaluation {
  std::string name;
  std::size_t frames = 0;  ///< number of frames in the truth
  std::size_t stated = 0;  ///< number of frames with a stated pose
  std::size_t lost = 0;    ///< number of frames without a stated pose, after the first one
  std::size_t turned = 0;  ///< number of stated poses that were compared half a turn from where they were stated
  std::vector<double> symmetries;  ///< by how much each half turn that counts as none moves the surface [m]
  Distribution position;           ///< distance of the origins [m]
  Distribution rotation;           ///< angle between the orientations [rad]
  Distribution surface;            ///< mean distance of the stated surface's points from the true surface [m], as ADD-S
};

/// Compares over the frames of the truth. Without any stated pose, the object was never found. Error: poses are stated,
/// but in no frame of the truth.
Result<ObjectEvaluation> evaluate_object(const ObjectTruthTable& truth, const ObjectPoses& stated,
                                         const ObjectMesh& mesh);

}  // namespace barehand
