#pragma once

#include <span>
#include <vector>

#include "object/known_object.h"
#include "stages/known_object/observed_depth.h"

namespace barehand {

/// How well a pose agrees with a frame.
struct PoseQuality {
  Visibility visibility;
  double explained = 0;  ///< fraction of the points within the object's bounding sphere that lie on its surface
  double cost() const { return 1 - explained + 2 * visibility.inconsistent(); }
  /// Whether enough shows of an object that was not known to be there, and whether it agrees with the frame.
  bool acceptable() const;
};

/// A pose that was found, with its quality.
struct FoundPose {
  SE3 T_camera_object;
  PoseQuality quality;
};

/// Looks for an object around a place without any idea of its pose: tries hundreds of orientations, moves each until it
/// fits, and refines the best ones. The result depends on the points only. Reuses its memory, that of the result, too.
class ObjectSearch {
 public:
  ObjectSearch();
  /// The poses that agree with the frame, the best one first: at most kMostPoses, with surfaces that differ. `points`:
  /// of everything that may be the object; `seed`: the place [m].
  std::span<const FoundPose> search(const KnownObject& object, const ObservedDepth& view,
                                    std::span<const Eigen::Vector3f> points, const Eigen::Vector3f& seed);
  static constexpr std::size_t kMostPoses = 3;

 private:
  SE3 place(const KnownObject& object, const Eigen::Matrix3d& R, const Eigen::Vector3d& middle) const;
  Eigen::Vector3f gather(const KnownObject& object, std::span<const Eigen::Vector3f> points, Eigen::Vector3f middle);
  double misfit(const KnownObject& object, const SE3& T) const;
  void refine(const KnownObject& object, const ObservedDepth& view, std::span<const Eigen::Vector3f> points,
              const SE3& start);

  std::vector<Eigen::Matrix3d> orientations_;
  std::vector<Eigen::Vector3f> around_, few_, near_;  // points around the place, a few of them, points near a pose
  std::vector<FoundPose> found_;
};

/// Whether a motion is a small turn, or leaves the surface where it is, as a turn of a bottle about its axis does.
bool changes_little(const KnownObject& object, const SE3& T_object_object);

/// The quality of a pose. `points`: of everything that may be the object.
PoseQuality quality_of(const KnownObject& object, const ObservedDepth& view, const SE3& T_camera_object,
                       std::span<const Eigen::Vector3f> points);

}  // namespace barehand
