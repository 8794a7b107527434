#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "drivers/synthetic/hand/hand_mesh.h"
#include "drivers/synthetic/hand/skeleton.h"
#include "drivers/synthetic/rendering/scene_geometry.h"

namespace barehand::synthetic {

// The interface of simulated sequences.

/// The hand for which sequences are made, always a right one; a left hand is simulated by mirroring.
struct HandRig {
  HandMesh mesh;
  HandProfile profile;  ///< measured on the mesh
};

/// An object of the scene other than the hands, with its surface in its own frame.
struct SceneObject {
  std::string name;
  TriangleMesh mesh;
  Material material;
  bool grasped = false;  ///< a hand grasps it; at most one object of a sequence
};

/// The state of one hand at one time, as a right hand in the camera frame; a left hand is its mirror image in x = 0.
struct HandState {
  SkeletonPose skeleton;
  Eigen::Vector3d elbow = Eigen::Vector3d::Zero();  ///< position of the elbow, where the forearm ends [m]
};

/// The state of the whole scene at one time, in the camera frame.
struct SceneState {
  std::vector<HandState> hands;      ///< as many as SequenceInfo says; if there are two, the right one comes first
  std::vector<SE3> T_camera_object;  ///< one for each object of the sequence
  bool held = false;                 ///< the grasped object moves with the hand
};

/// A motion of hands and objects, as a pure function of time.
class Sequence {
 public:
  virtual ~Sequence() = default;
  virtual double duration() const = 0;  ///< duration of the sequence [s]
  virtual const std::vector<SceneObject>& objects() const = 0;
  virtual SceneState at(double time) const = 0;
  /// Class of the grasp (hand/grasps/grasp_types.h) while the object is held; empty if nothing is grasped.
  virtual std::string_view grasp_type() const { return {}; }
};

/// The hands that a sequence shows: none, one that may be a right or a left hand, or both a right and a left hand.
enum class ShownHands { none, one, both };

/// Description of a sequence that a user can select.
struct SequenceInfo {
  std::string name, description;
  int frames = 0;  ///< number of frames at `fps`
  double fps = 30;
  ShownHands shows = ShownHands::one;
};
/// All sequences that a user can select.
const std::vector<SequenceInfo>& sequence_list();

/// The description of a sequence. Error: there is no such sequence; the message names those that exist.
Result<SequenceInfo> sequence_info(const std::string& name);

/// What the sequence `grasp` shows, by name; an empty name is drawn by the seed.
struct GraspChoice {
  std::string object, type;
};

/// Creates a sequence. `rig`: needed by sequences with one hand, and used during the call only; null for the others.
/// Errors: as for sequence_info() and make_varied_grasp().
Result<std::unique_ptr<Sequence>> make_sequence(const std::string& name, const HandRig* rig, std::uint64_t seed,
                                                const GraspChoice& choice = {});

}  // namespace barehand::synthetic
