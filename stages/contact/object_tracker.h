#pragma once

#include <span>
#include <vector>

#include "stages/contact/object_track.h"
#include "stages/contact/surface_links.h"

namespace barehand {

/// Distinguishes objects, keeps their ids from frame to frame, and fuses the visible surface of each into a model.
/// Surfaces that lie on the model of an object belong to it; others are one object if they are linked. An object is
/// held while it moves with a palm; what continues out of view, as a table does, is never held and has no model.
class ObjectTracker {
 public:
  /// Removes the points of specks, sets SurfacePoint::object of the others, and appends points of the objects' models
  /// that are hidden in this frame. `open`: as SurfaceCells::collect() fills it.
  void process(std::int64_t utime, const HandEstimates& estimates, const ObservedSpace& space,
               const std::vector<bool>& open, std::vector<SurfacePoint>& points, FrameVector<ObjectEstimate>& objects);
  /// The objects as of the last frame.
  std::span<const ObjectTrack> tracks() const { return tracks_; }
  /// Stores which objects the hands touch in this frame: they probably move with the hands.
  void note_touches(std::span<const HandContacts> hands);
  /// Whether a point (camera frame [m]) was seen to be empty while nothing covered it, so that it is not part of this
  /// object.
  bool seen_empty(std::int32_t object, const Eigen::Vector3f& p) const;

 private:
  /// The linked surfaces of one object in this frame that lie on no model.
  struct Cluster {
    int count = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // sum of the points
    bool open = false;
    int track = -1;  // index into tracks_; -1: a speck
    Eigen::Vector3d centre() const { return sum / count; }
  };

  void match_models(std::int64_t utime, const ObservedSpace& space, const std::vector<SurfacePoint>& points);
  void match_centres(std::int64_t utime, const std::vector<SurfacePoint>& points);
  void merge(std::int64_t utime);
  void give_points(std::vector<SurfacePoint>& points);

  SurfaceLinks links_;
  std::vector<const SurfacePoint*> all_;   // points of the frame
  std::vector<int> count_, near_, owner_;  // for each component: points, points on each model, track of its model or -1
  std::vector<Cluster> clusters_;          // indexed by the first component; those of the other components are empty
  std::vector<ObjectTrack> tracks_;
  std::int64_t last_ = 0;  // time of the last frame [us]
  std::int32_t next_id_ = kFirstUnknownObject;
};

}  // namespace barehand
