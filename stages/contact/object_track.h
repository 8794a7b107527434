#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hand/contacts.h"
#include "hand/grasps/holding.h"
#include "hand/hand_pose.h"
#include "object/round_shape.h"
#include "stages/contact/object_model.h"

namespace barehand {

/// One object from frame to frame: its model, its pose, and whether it is held. In each frame, call predict(), then
/// assign the object's points, then call update().
struct ObjectTrack {
  ObjectEstimate state;
  ObjectModel model;                                 ///< of nothing while the object is open
  std::vector<const SurfacePoint*> points;           ///< its points in this frame; empty after update()
  SE3 predicted;                                     ///< T_camera_object in this frame
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< centre of the points that were seen last, camera frame [m]
  bool open = false;                                 ///< it continues out of view, as a table does: it has no model
  bool placed = false;                               ///< some of its points lie on its model in this frame
  int touches = 0;                                   ///< segments that touched it in the last frame
  std::int64_t seen = 0;                             ///< time of the last frame with a part of it [us]

  std::optional<RoundShape> round;  ///< in its frame, if what is known of it is round
  KnownObjectPtr round_object;      ///< with that shape; null without it

  /// Gives it the id of another track of the same object. Its shape, which carries the id, is fitted anew.
  void rename(std::int32_t id);
  bool modelled() const { return !open && model.has_surface(); }

  /// Predicts where the object is: where it was, or where it was in the palm, whichever agrees better with all points
  /// of the frame.
  void predict(const HandEstimates& estimates, const ObservedSpace& space, std::span<const SurfacePoint* const> all);
  /// Updates the pose, the model, and whether the object is held. `elapsed`: since the last frame [s]; 0: not known.
  void update(std::int64_t utime, double elapsed, const HandEstimates& estimates, const ObservedSpace& space);

 private:
  void place(double elapsed, const ObservedSpace& space);
  void find_shape();

  Holding holding_;
  std::vector<SurfaceSample> surface_;  // what is known of its surface
  int shape_age_ = 0;                   // frames since `round` was first fitted to the model
};

}  // namespace barehand
