#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/log.h"
#include "core/slot.h"
#include "drivers/lcm/command.h"
#include "tracking/two_hand_tracker.h"

namespace barehand {

/// A tracker of hands that executes commands from outside (command_t) between two frames: reset, start at a pose, use
/// another hand profile. A command that cannot be read or executed is reported and changes nothing. Commands are
/// limited like a token bucket: up to kBurst frames may execute commands, and one more is allowed every kPause frames.
/// Of the commands that wait, only the newest of each kind and hand is kept.
class CommandedTracker {
 public:
  static constexpr int kBurst = 3, kPause = 150;

  /// Returns the commands that arrived since its last call. It is called before every frame, on the thread of
  /// process(). An empty function: there are no commands.
  using Inbox = std::function<std::vector<Result<Command>>()>;

  /// `changed`: changed parameters, taken before every frame; may be null. It, `workers` and `log` must outlive the
  /// tracker.
  CommandedTracker(const TrackerParams& params, const TwoHandTracker::Profiles& profiles, std::uint64_t seed,
                   Workers& workers, Inbox inbox, RepeatLog& log, Slot<TrackerParams>* changed = nullptr);

  /// Executes commands, then tracks the hands in this frame (TwoHandTracker::process). Never returns an error: the
  /// pipeline requires this type of every stage.
  Result<HandEstimates> process(HandObservations& observations);
  /// Lets the hands couple with the objects near them (CoupleWith), from the next frame on.
  void couple_with(std::span<const NearbyObject> objects) { tracker_.couple_with(objects); }
  /// Tracks the first hand from this pose, T_camera_segment, on.
  void start_at(const HandPose& pose) { tracker_.start_at(0, pose); }

 private:
  void collect(const std::string& sensor);
  bool make_room_for(const Command& command);
  void follow_waiting();
  std::vector<int> concerned(const Command& command) const;
  void follow(const Command& command);
  void use(const std::vector<int>& hands, HandProfile profile);

  const Inbox inbox_;
  RepeatLog& log_;
  Slot<TrackerParams>* const changed_;
  TwoHandTracker tracker_;
  HandEstimates last_;
  // At most one command of each kind and hand, oldest first; of profiles for any hand, as many as there are hands.
  std::vector<Command> waiting_;
  int allowed_ = kBurst;  // number of frames that may still execute commands
  int frames_ = 0;
};

}  // namespace barehand
