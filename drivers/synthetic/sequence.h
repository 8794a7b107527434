#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "drivers/synthetic/hand_mesh.h"
#include "drivers/synthetic/scene_geometry.h"
#include "drivers/synthetic/skeleton.h"

namespace barehand::synthetic {

/// The hand that sequences are made for: always a right one (a left hand is simulated in a mirror).
struct HandRig {
  HandMesh mesh;
  HandProfile profile;  ///< measured on it
};

/// A thing beside the hand, with its surface in its own frame.
struct SceneObject {
  std::string name;
  TriangleMesh mesh;
  Material material;
};

/// Where a hand is at one time, as a right one: a left hand is where the mirror x = 0 shows it. Camera frame.
struct HandState {
  SkeletonPose skeleton;
  Eigen::Vector3d elbow = Eigen::Vector3d::Zero();  ///< where the forearm leads to
};

/// Where everything is at one time. Camera frame.
struct SceneState {
  std::vector<HandState> hands;      ///< as many as SequenceInfo says; of two the right one comes first
  std::vector<SE3> T_camera_object;  ///< one for every object of the sequence
};

/// A motion of hands and things: a pure function of time.
class Sequence {
 public:
  virtual ~Sequence() = default;
  virtual double duration() const = 0;  ///< [s]
  virtual const std::vector<SceneObject>& objects() const = 0;
  virtual SceneState at(double time) const = 0;
};

/// What a user can ask for.
struct SequenceInfo {
  std::string name, description;
  int frames = 0;  ///< at `fps`
  double fps = 30;
  bool both_hands = false;  ///< a right and a left one; otherwise one, of either side
};
const std::vector<SequenceInfo>& sequence_list();

/// Error if there is no such sequence, naming those that exist.
Result<SequenceInfo> sequence_info(const std::string& name);

/// `rig` is used for one-handed sequences and only in the call. Error as of sequence_info.
Result<std::unique_ptr<Sequence>> make_sequence(const std::string& name, const HandRig& rig, std::uint64_t seed);

}  // namespace barehand::synthetic
