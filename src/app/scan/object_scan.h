#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stages/contact/object_track.h"

namespace barehand {

/// Chooses the object that a person turns in front of the sensor, and keeps what has been seen of it.
class ObjectScan {
 public:
  /// What has been seen of one object.
  struct Object {
    std::int32_t id = 0;
    int held = 0;                        ///< number of frames in which it was held
    std::vector<SurfaceSample> surface;  ///< surface in the object's own frame [m]
  };

  /// Stores the state of the objects after a frame.
  void add(std::span<const ObjectTrack> tracks);
  /// The object that was held in the most frames, of those that may be a solid; if none was held, the one with the most
  /// surface. Null: there is none.
  const Object* object() const;
  int frames() const { return frames_; }

 private:
  std::vector<Object> objects_;  // those of the last frame, and the best of all others
  int frames_ = 0;
};

}  // namespace barehand
