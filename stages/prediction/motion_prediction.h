#pragma once

#include <array>
#include <string>

#include "core/memory/frame_memory.h"
#include "hand/hand_pose.h"
#include "observe/registration/observed_cloud.h"
#include "observe/registration/rigid_icp.h"
#include "observe/registration/visible_points.h"

namespace barehand {

/// Transition between frames (paper Sec. 4.4): ICP for the global motion, and a constant velocity of every segment
/// relative to it. Deviation from the paper: at sensor rate, unseen segments keep their pose relative to the global
/// motion, since their velocity would be noise that amplifies itself.
struct PredictionParams {
  bool velocity = true;
  double damping = 0.7;
  double unseen_damping = 0.0;
  double slow_unseen_damping = 0.5;
  double slow_rate = 10;
  double smoothing = 0.0;
  double max_speed = 2.0;
  double max_angular_speed = 20;
  double max_interval = 0.5;
  bool operator==(const PredictionParams&) const = default;
};

template <class V>
void visit(V& v, PredictionParams& p) {
  v("velocity", p.velocity, "predict each segment with constant velocity relative to the global motion (Sec. 4.4)");
  v("damping", p.damping, 0.0, 1.0, "fraction of a seen segment's relative velocity that is kept");
  v("unseen_damping", p.unseen_damping, 0.0, 1.0,
    "fraction of an unseen segment's relative velocity that is kept at sensor rate");
  v("slow_unseen_damping", p.slow_unseen_damping, 0.0, 1.0,
    "fraction of an unseen segment's relative velocity that is kept below slow_rate");
  v("slow_rate", p.slow_rate, 0.0, 1000.0, "Hz, frame rate below which unseen segments keep some velocity");
  v("smoothing", p.smoothing, 0.0, 0.99,
    "weight of the previous velocity in the new one; 0: the last difference alone");
  v("max_speed", p.max_speed, 0.0, 100.0, "m/s, limit of the relative velocity");
  v("max_angular_speed", p.max_angular_speed, 0.0, 1000.0, "rad/s, limit of the relative angular velocity");
  v("max_interval", p.max_interval, 1e-3, 60.0, "s, after a longer gap between frames velocities are discarded");
}

/// A pose from which refinement of the next frame may start. The tracker chooses between these candidates by their
/// global score.
struct StartPose {
  std::string name;  ///< held, icp, icp_velocity, velocity
  HandPose pose;
};

/// The start poses of one frame, and the global motion that led to them.
struct Prediction {
  FrameVector<StartPose> candidates;  ///< the first one is primary: the first search level draws samples around it
  IcpResult icp;
  std::int64_t utime = 0;  ///< time stamp of the observation [us]
  double dt = 0;           ///< time since the last pose [s]
  const HandPose& primary() const { return candidates.front().pose; }
};

/// The motion model of a hand: the last pose and the velocities that led to it. It predicts the next frame's poses.
class MotionModel {
 public:
  MotionModel(const PredictionParams& params, const IcpParams& icp_params) : params_(params), icp_params_(icp_params) {}

  bool has_pose() const { return has_pose_; }
  const HandPose& pose() const { return pose_; }
  std::int64_t utime() const { return utime_; }

  /// Starts again from a pose without velocity. `utime`: time stamp of the observation that it belongs to [us].
  void restart(const HandPose& pose, std::int64_t utime);
  /// Records the estimate of a frame whose prediction was `prediction`. `seen`: segments that were estimated from data.
  void update(const HandPose& pose, const std::array<bool, kSegmentCount>& seen, const Prediction& prediction);
  void forget() { has_pose_ = false; }

  /// Candidates for an observation; call only if has_pose(). With few hand points, the only candidate is the last pose
  /// (`held`). Equal time stamps mean that nothing moved. Decreasing time stamps, as of a recording played backwards,
  /// are treated like increasing ones.
  Prediction predict(const HandObservation& observation, const HandSurface& surface);

 private:
  HandPose with_velocity(const HandPose& moved, const SE3& motion, double dt) const;
  double damping_of(int segment, double dt) const;

  PredictionParams params_;
  IcpParams icp_params_;
  bool has_pose_ = false;
  std::int64_t utime_ = 0;
  HandPose pose_;
  std::array<bool, kSegmentCount> seen_{};
  std::array<Vector6d, kSegmentCount> velocity_{};  // twist of each segment relative to the global motion [per second]
  Vector6d global_velocity_ = Vector6d::Zero();     // twist of the palm under the global motion [per second]
  ObservedCloud cloud_;
  VisiblePoints visible_points_;
};

/// Moves the whole pose rigidly by `motion` (camera frame).
HandPose moved(const SE3& motion, const HandPose& pose);

}  // namespace barehand
