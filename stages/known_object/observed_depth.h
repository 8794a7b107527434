#pragma once

#include <vector>

#include "object/known_object.h"
#include "observe/observation.h"

namespace barehand {

/// How much of an object a frame shows, counted in samples of the surface that would be seen if nothing were in front
/// of it.
struct Visibility {
  int seen = 0;     ///< the surface is measured where the pose says
  int hidden = 0;   ///< a hand is in front of it, or there is no measurement
  int blocked = 0;  ///< something else is in front of it
  int through = 0;  ///< the camera looks through the place where it would be

  double shown() const { return seen / std::max(1.0, static_cast<double>(seen + hidden + blocked + through)); }
  /// The fraction of the visible samples that contradicts the pose.
  double contradicted() const { return seen + through == 0 ? 1 : through / static_cast<double>(seen + through); }
  /// The same, if only hands may be in front of the object.
  double inconsistent() const {
    return (through + blocked) / std::max(1.0, static_cast<double>(seen + through + blocked));
  }
};

/// The depth of one frame without its hands. It shares the observations, which must be of one frame.
class ObservedDepth {
 public:
  explicit ObservedDepth(HandObservations observations);

  /// Appends points that are no hand's and at most `reach` from the surface of the posed object, `most` at most. Pixels
  /// at the edge of a surface are left out.
  void points_near(const KnownObject& object, const SE3& T_camera_object, double reach, std::size_t most,
                   std::vector<Eigen::Vector3f>& points) const;
  /// Compares the pose with the depth, with the first `samples` samples of the object.
  Visibility visibility(const KnownObject& object, const SE3& T_camera_object, std::size_t samples) const;
  /// How much of the outline of the object is none in the frame: the fraction of directions in which what is measured
  /// beyond its last visible place continues the surface there. A face of an object that is taken for a part of a table
  /// continues everywhere.
  double continued(const KnownObject& object, const SE3& T_camera_object) const;
  double noise() const { return noise_; }

 private:
  template <class Wanted, class Visit>
  void visit_visible(const KnownObject& object, const SE3& T_camera_object, std::size_t samples, Wanted wanted,
                     Visit visit) const;
  bool of_hand(int u, int v) const;
  double depth(int u, int v) const;  // [m]; 0: no measurement
  double smoothed(int u, int v) const;
  bool at_edge(int u, int v, double z) const;
  int Visibility::*shows(int u, int v, double z, double alike) const;

  HandObservations observations_;
  const RgbdFrame* frame_;  // of the observations
  double noise_ = 0.001;
};

}  // namespace barehand
