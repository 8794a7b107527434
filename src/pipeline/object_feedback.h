#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "core/feedback.h"
#include "core/memory/frame_memory.h"
#include "hand/hand_pose.h"
#include "object/known_object.h"

namespace barehand {

/// Hands the objects near the hands back from the thread of the sinks, which tracks them, to the tracker of the hands.
/// The tracker gets in each frame the objects of exactly kLag frames before, whatever the speed of the threads. One
/// thread calls wait() and next(), another one post().
class ObjectFeedback {
 public:
  /// With 2, a tracker of a live run hardly ever waits for the sinks, which then are behind by no more than a frame.
  static constexpr std::int64_t kLag = 2;

  /// The objects of kLag frames before the next one to be tracked. Waits until they are known.
  const FrameVector<NearbyObject>& wait();
  /// Call once for every frame that was tracked and so will be posted.
  void next() { ++tracked_; }
  /// Call once for every frame that was tracked, in the same order, whether or not its objects could be found.
  void post(FrameVector<NearbyObject> objects) { results_.post(posted_++, std::move(objects)); }

  /// Posts the objects of a frame at the end of the scope in which they are found: none if that fails.
  struct Posting {
    ObjectFeedback* feedback;  ///< null: no tracker waits
    FrameVector<NearbyObject> objects = {};
    ~Posting() {
      if (feedback) feedback->post(std::move(objects));
    }
  };

 private:
  Feedback<FrameVector<NearbyObject>> results_;
  FrameVector<NearbyObject> objects_;
  std::int64_t tracked_ = 0, taken_ = 0;  // of the tracker's thread
  std::int64_t posted_ = 0;               // of the other thread
};

/// Places objects in the palm with which they move, or in the camera frame. Call place() frame after frame.
class ObjectPlaces {
 public:
  /// Objects whose place is known too badly for a hand to rely on are left out.
  FrameVector<NearbyObject> place(std::span<const PosedObject> objects, const HandEstimates& estimates);

 private:
  /// How far an object moved from frame to frame.
  struct Motion {
    std::int32_t hand_id = -1;           // the hand that is nearest to it
    Eigen::Vector3d in_camera, in_palm;  // its middle in the last frame
    double by_camera = 0, by_palm = 0;   // smoothed ways from frame to frame [m]

    void add(std::int32_t hand, const Eigen::Vector3d& now_in_camera, const Eigen::Vector3d& now_in_palm);
  };
  std::map<std::int32_t, Motion> motions_;  // by id of the object
};

}  // namespace barehand
