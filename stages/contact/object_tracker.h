#pragma once

#include <vector>

#include "hand/contacts.h"
#include "hand/hand_pose.h"
#include "stages/contact/surface_cells.h"

namespace barehand {

/// Joins connected surfaces to objects and keeps their ids from frame to frame. A hand covers parts of what it holds,
/// so surfaces that are a finger's width apart are one object. An object is held while it moves with a palm; what
/// continues out of view, as a table does, is never held.
class ObjectTracker {
 public:
  /// `first_id`: the id of the first object; smaller ones belong to others.
  explicit ObjectTracker(std::int32_t first_id = 1) : next_id_(first_id) {}

  /// Removes points of specks, and sets SurfacePoint::object of the others. `open`: as SurfaceCells::collect() fills
  /// it.
  void process(std::int64_t utime, const HandEstimates& estimates, const std::vector<bool>& open,
               std::vector<SurfacePoint>& points, FrameVector<SeenObject>& objects);

 private:
  /// All surfaces of one object in this frame.
  struct Thing {
    int count = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), lower, upper;  // of the points
    bool open = false;
    int track = -1;  // index into tracks_; -1: a speck
    Eigen::Vector3d centre() const { return sum / count; }
  };
  struct Track {
    SeenObject state;
    std::int64_t seen = 0;          // time of the last frame with a part of it [us]
    Eigen::Vector3d in_palm, palm;  // place relative to the palm, and place of the palm, when both were first compared
    std::int32_t companion = -1;    // hand_id of that palm; -1: none
  };

  void link(const std::vector<bool>& open, const std::vector<SurfacePoint>& points);
  void match(std::int64_t utime);
  void update(Track& track, const Thing& thing, std::int64_t utime, const HandEstimates& estimates);

  std::vector<std::int32_t> parent_;  // of each component, towards the first one of the same object
  std::vector<std::pair<std::uint64_t, std::int32_t>> voxels_;  // occupied voxels with a component in them, by key
  std::vector<Thing> things_;  // by first component; those of the other components are empty
  std::vector<Track> tracks_;
  std::int32_t next_id_;
};

}  // namespace barehand
