#pragma once

#include <map>
#include <optional>
#include <span>

#include "hand/contacts.h"
#include "hand/hand_pose.h"
#include "object/known_object.h"
#include "stages/known_object/holding.h"
#include "stages/known_object/object_fit.h"
#include "stages/known_object/object_search.h"
#include "stages/known_object/observed_depth.h"

namespace barehand {

/// Tracks one known object. The pose is predicted from its velocity and from the palms, and refined on the depth near
/// the prediction; since the search starts from there, a symmetric object does not jump. When the fit is bad or too
/// little shows, there is no pose, and every few frames the object is searched for.
class KnownObjectTracker {
 public:
  explicit KnownObjectTracker(KnownObjectPtr object) : object_(std::move(object)) {}

  /// The object in this frame; none: it was not found. `points`: those near the hands that no other known object has
  /// claimed.
  std::optional<ObjectEstimate> process(std::int64_t utime, const ObservedDepth& view, const HandEstimates& estimates,
                                        std::span<const Eigen::Vector3f> points);
  const KnownObjectPtr& object() const { return object_; }

 private:
  /// A pose that the object may have now, and how far it may be off.
  struct Prediction {
    SE3 T;
    double shift = 0, turn = 0;  // standard deviations [m], [rad]
  };
  std::vector<Prediction> predictions(double dt, const HandEstimates& estimates) const;
  bool follow(double dt, const ObservedDepth& view, const HandEstimates& estimates,
              std::span<const Eigen::Vector3f> points);
  bool find(const ObservedDepth& view, const HandEstimates& estimates, std::span<const Eigen::Vector3f> points);
  void store_palms(std::int64_t utime, const HandEstimates& estimates);

  KnownObjectPtr object_;
  ObjectSearch search_;
  Holding holding_;
  std::optional<SE3> T_;  // T_camera_object in the previous frame; predicted if the object was not seen there
  Vector6d velocity_ = Vector6d::Zero();
  Matrix6d covariance_ = Matrix6d::Identity();
  std::map<std::int32_t, SE3> palms_;  // T_camera_palm of every hand in the previous frame
  std::int64_t utime_ = 0, seen_ = 0;  // times of the previous frame and of the last one that showed the object [us]
  int wait_ = 0, searches_ = 0;        // frames until the next search; searches so far
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace barehand
