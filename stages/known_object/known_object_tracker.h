#pragma once

#include <map>
#include <optional>
#include <span>

#include "hand/contacts.h"
#include "hand/grasps/holding.h"
#include "hand/hand_pose.h"
#include "object/known_object.h"
#include "stages/known_object/object_fit.h"
#include "stages/known_object/object_search.h"
#include "stages/known_object/observed_depth.h"

namespace barehand {

/// Tracks one known object. The pose is predicted from its velocity and from the palms, and refined on the depth near
/// the prediction; since the refinement starts from there, a symmetric object does not jump. When the fit is bad or too
/// little shows, there is no pose, and the object is searched for. Where a search finds several poses, all are
/// followed, until the frames have shown which one is right. While it is followed, searches more and more seldom look
/// whether another pose explains it better, for little may have been seen when it was found. A search takes some
/// frames, so that none waits long for it; what it finds has moved by then.
class KnownObjectTracker {
 public:
  explicit KnownObjectTracker(KnownObjectPtr object) : object_(std::move(object)), search_(object_) {}

  /// The object in this frame; none: it was not found. `points`: those near the hands that no other known object has
  /// claimed.
  std::optional<ObjectEstimate> process(std::int64_t utime, const ObservedDepth& view, const HandEstimates& estimates,
                                        std::span<const Eigen::Vector3f> points);
  const KnownObjectPtr& object() const { return object_; }

 private:
  /// A pose that the object may have, from frame to frame.
  struct Hypothesis {
    SE3 T;       // in the frame before; predicted if it was not seen there
    SE3 T_then;  // in the frame in which the search that is under way began
    Vector6d velocity = Vector6d::Zero();
    Matrix6d covariance;
    double misfit = 0;  // negative logarithm of the likelihood of the frames so far
    bool seen = false;  // in this frame
  };
  /// A pose that follows from a hypothesis, and how far it may be off.
  struct Prediction {
    SE3 T;
    double shift = 0, turn = 0;  // standard deviations [m], [rad]
  };
  using Palms = std::map<std::int32_t, SE3>;  // T_camera_palm of every hand that is tracked
  static Palms palms_of(const HandEstimates& estimates);
  void predict(const Hypothesis& hypothesis, double dt, const HandEstimates& estimates);
  bool follow(double dt, const ObservedDepth& view, const HandEstimates& estimates,
              std::span<const Eigen::Vector3f> points);
  void refine(Hypothesis& hypothesis, double dt, const ObservedDepth& view, std::span<const Eigen::Vector3f> points);
  void compare(const ObservedDepth& view);
  bool find(std::int64_t utime, double dt, const ObservedDepth& view, const HandEstimates& estimates,
            std::span<const Eigen::Vector3f> points);
  void look_again(std::int64_t utime, double dt, const ObservedDepth& view, const HandEstimates& estimates,
                  std::span<const Eigen::Vector3f> points);
  void begin_search(std::int64_t utime, const ObservedDepth& view, const HandEstimates& estimates,
                    std::span<const Eigen::Vector3f> points, const Eigen::Vector3f& seed);
  void follow_also(const SE3& moved);

  KnownObjectPtr object_;
  ObjectSearch search_;
  Holding holding_;
  std::vector<Hypothesis> hypotheses_;  // the first one is stated; empty: it was not seen for long
  std::vector<Prediction> predictions_;
  Palms palms_;                        // in the frame before
  std::int64_t utime_ = 0, seen_ = 0;  // of the frame before, and of the last one in which it was seen [us]
  int compared_ = 0;                   // frames in which the hypotheses were compared
  std::int64_t found_ = 0, look_ = 0;  // time at which it was found, and how long after that it is searched again [us]
  int searches_ = 0;                   // searches since it was found last
  std::int64_t first_search_ = 0, search_began_ = 0;  // times of the first and the last of them [us]
  Palms palms_then_;                                  // when the last one began
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace barehand
