#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/error.h"
#include "drivers/synthetic/grasped_object.h"
#include "drivers/synthetic/hand/animated_hand.h"
#include "drivers/synthetic/rendering/depth_noise.h"
#include "io/hand/result_table.h"
#include "sensor/rgbd_frame.h"

namespace barehand::synthetic {

// The simulator: renders the frames of a sequence with their ground truth.

/// Parameters of a simulation; visit() states the meaning of each.
struct SimulatorParams {
  std::string sequence = "fist";  ///< a name of sequence_list()
  std::string noise = "none";
  int seed = 1;
  double fps = 0;
  int frames = 0;
  double speed = 1;
  std::string hand = "right";
  std::string sleeve = "blue";
  int width = 640, height = 480;
  double focal = 0;
  HandShape shape;
  std::string object, grasp;
};
template <class V>
void visit(V& v, SimulatorParams& p) {
  // These options set the sensor's noise and the random numbers.
  v("noise", p.noise, {"none", "kinect", "tof"}, "sensor whose noise is simulated");
  v("seed", p.seed, 0, 1000000000, "seed of motion and noise");

  // These set the rate, the length and the speed of the sequence.
  v("fps", p.fps, 0.0, 1000.0, "frames per second; 0: the sequence's own");
  v("frames", p.frames, 0, 10000000, "number of frames; 0: the whole sequence");
  v("speed", p.speed, 0.05, 20.0, "factor on the speed of the motion");

  // These set which hand and which forearm are seen.
  v("hand", p.hand, {"right", "left"},
    "which hand is shown, in sequences with one hand; a left hand is a mirror image");
  v("sleeve", p.sleeve, {"blue", "skin", "none"},
    "what the forearm wears: a blue sleeve, or nothing (skin); none: there is no forearm");

  // These describe the camera.
  v("width", p.width, 64, 4096, "px, width of the images");
  v("height", p.height, 48, 4096, "px, height of the images");
  v("focal", p.focal, 0.0, 10000.0, "px, focal length; 0: 525 at a width of 640, and in proportion");

  // The last ones set the shape of the hand, and what it grasps.
  visit(v, p.shape);
  v("object", p.object, "object of the sequence grasp; empty: drawn by the seed");
  v("grasp", p.grasp, "class of the sequence grasp, such as wrap or pinch; empty: drawn by the seed");
}

/// The truth about one hand in one frame.
struct HandTruth {
  HandPose pose;                      ///< T_camera_segment
  std::optional<TableFrame> table;    ///< none if no part of this hand is in the image
  std::vector<Eigen::Vector3f> skin;  ///< vertices of the skin, camera frame [m]
};

/// One simulated frame and the truth about its hands.
struct SimulatedFrame {
  FramePtr frame;
  std::vector<HandTruth> hands;       ///< in the order of Simulator::hands()
  std::optional<ObjectTruth> object;  ///< truth of Simulator::grasped(); none if nothing is grasped
};

/// Renders a sequence: up to two animated hand meshes with sleeves, bodies and objects, as a range camera sees them.
/// Frame i is a pure function of the parameters and of i. Not to be used by several threads at once.
class Simulator {
 public:
  static constexpr double kDepthUnit = 0.0001;            ///< unit of the depth image [m]
  static constexpr std::int64_t kFirstUtime = 1'000'000;  ///< time stamp of frame 0 [us]

  /// Errors: the hand mesh was not fetched or is unusable, there is no such sequence, or a left hand is requested from
  /// a sequence with both hands or none. `mesh_folder`: see hand_mesh_folder().
  static Result<Simulator> create(const SimulatorParams& params, const std::string& mesh_folder = {});

  /// Renders the frame with this number.
  SimulatedFrame render(std::int64_t number);

  /// The contacts of a hand of a rendered frame with the grasped object; none without such an object. Measured on
  /// request, since it takes milliseconds.
  std::optional<HandContacts> contacts(const SimulatedFrame& frame, std::size_t hand) const;

  std::int64_t frame_count() const { return frame_count_; }
  double fps() const { return fps_; }
  const Intrinsics& camera() const { return rasteriser_.camera(); }
  /// The simulated hands: none, one, or a right and a left one.
  const std::vector<AnimatedHand>& hands() const { return hands_; }
  /// The object that a hand grasps; null: there is none.
  const GraspedObject* grasped() const { return grasped_ ? &*grasped_ : nullptr; }
  /// Class of the grasp; empty if nothing is grasped.
  std::string_view grasp_type() const { return sequence_->grasp_type(); }
  const SimulatorParams& params() const { return params_; }

 private:
  Simulator(const SimulatorParams& params, const Intrinsics& camera);
  // Whether the whole scene is mirrored, because it shows a single left hand.
  bool mirrors() const { return params_.hand == "left"; }
  // The triangles of the scene's objects.
  SceneGeometry object_geometry(const SceneState& state) const;
  // The material of every surface of the scene.
  std::vector<Material> materials() const;
  // Adds the sensor's noise to an ideal depth image.
  Image<float> add_noise(const RenderedView& view, std::int64_t number) const;
  // The truth about the grasped object; none if nothing is grasped.
  std::optional<ObjectTruth> object_of(const SceneState& state) const;
  // The truth table of one hand; none if it is not in the image.
  std::optional<TableFrame> table_of(std::size_t hand, const RenderedView& view, const SceneGeometry& geometry,
                                     const HandPose& pose) const;

  SimulatorParams params_;
  std::int64_t frame_count_ = 0;
  double fps_ = 30;
  std::vector<AnimatedHand> hands_;
  std::unique_ptr<Sequence> sequence_;
  std::optional<GraspedObject> grasped_;
  DepthNoise noise_;
  Rasteriser rasteriser_;
};

}  // namespace barehand::synthetic
