#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/error.h"
#include "core/log.h"
#include "core/slot.h"
#include "drivers/lcm/command.h"
#include "tracking/two_hand_tracker.h"

namespace barehand {

/// A tracker of hands that takes commands from outside (command_t) between two frames: reset, start at a pose, another
/// hand profile. A command that cannot be read or followed is reported and changes nothing. A flood of commands cannot
/// keep it from tracking: commands are followed on kBurst frames, then on one of kPause; of those that come meanwhile
/// the newest of each kind and hand is followed then.
class CommandedTracker {
 public:
  static constexpr int kBurst = 3, kPause = 150;

  /// What arrived since the last call; asked before every frame, on the thread of `process`. Empty: no commands.
  using Inbox = std::function<std::vector<Result<Command>>()>;

  /// `changed`: where changed parameters arrive; looked at before every frame; may be null. It, `workers` and `log`
  /// outlive the tracker.
  CommandedTracker(const TrackerParams& params, const TwoHandTracker::Profiles& profiles, std::uint64_t seed,
                   Workers& workers, Inbox inbox, RepeatLog& log, Slot<TrackerParams>* changed = nullptr);

  /// Follows what arrived, and tracks the hands in this frame. An error never comes from here: it is the type that the
  /// pipeline wants of a stage.
  Result<HandEstimates> process(const HandObservations& observations);
  /// Of the first hand.
  void start_at(const HandPose& pose) { tracker_.hand(0).apply(StartAt{pose}); }

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
  std::vector<Command> waiting_;  // one of each kind and hand at most, a profile for any hand once a hand; oldest first
  int allowed_ = kBurst;          // frames on which commands may be followed
  int frames_ = 0;
};

}  // namespace barehand
