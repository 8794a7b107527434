#pragma once

#include <optional>
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
/// fits, and refines the best ones. Since that takes 10 to 60 ms, it can be done in parts, while other frames pass. The
/// result depends on the frame in which the search began only. Reuses its memory.
class ObjectSearch {
 public:
  explicit ObjectSearch(KnownObjectPtr object);
  /// Begins to search in a frame, in place of any search that is under way. `points`: of everything that may be the
  /// object; `seed`: the place [m]. If there are too few points around it, nothing is under way.
  void begin(const ObservedDepth& view, std::span<const Eigen::Vector3f> points, const Eigen::Vector3f& seed);
  bool under_way() const { return view_.has_value(); }
  /// Does a share of the work of the search that is under way, if one is; 1 is all of it. Whether it came to its end.
  bool advance(double share);
  void stop() { view_.reset(); }
  /// What the search that came to its end found: the poses that agree with its frame, the best one first, at most
  /// kMostPoses, with surfaces that differ.
  std::span<const FoundPose> found() const { return found_; }
  static constexpr std::size_t kMostPoses = 3;

 private:
  SE3 place(const Eigen::Matrix3d& R) const;
  Eigen::Vector3f gather(Eigen::Vector3f middle);
  double misfit(const SE3& T) const;
  void choose_starts();
  void refine(const SE3& start);
  void add_turns();
  void choose();

  KnownObjectPtr object_;
  std::vector<Eigen::Matrix3d> orientations_;

  std::optional<ObservedDepth> view_;          // of the search that is under way
  std::vector<Eigen::Vector3f> points_;        // of everything that may be the object
  std::vector<Eigen::Vector3f> around_, few_;  // points around the place, a few of them
  Eigen::Vector3d middle_;                     // of the points around the place
  std::vector<std::pair<double, SE3>> tried_;  // orientations in place, with their misfit, until there are starts
  std::vector<SE3> starts_;                    // poses to refine
  std::size_t refined_ = 0;                    // how many of them were
  std::vector<Eigen::Vector3f> near_;          // points near a pose
  std::vector<FoundPose> found_;
};

/// Whether a motion is a small turn, or leaves the surface where it is, as a turn of a bottle about its axis does.
bool changes_little(const KnownObject& object, const SE3& T_object_object);

/// The quality of a pose. `points`: of everything that may be the object.
PoseQuality quality_of(const KnownObject& object, const ObservedDepth& view, const SE3& T_camera_object,
                       std::span<const Eigen::Vector3f> points);

}  // namespace barehand
