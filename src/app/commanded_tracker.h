#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "app/hand_tracker.h"
#include "core/log.h"
#include "drivers/lcm/command.h"

namespace barehand {

/// A hand tracker that takes commands from outside (command_t) between two frames: reset, start at a pose, another
/// hand profile. A command that cannot be read or followed is reported and changes nothing. A flood of commands cannot
/// keep it from tracking: commands are followed on kBurst frames, then on one of kPause; of those that come meanwhile
/// the newest of each kind is followed then.
class CommandedTracker {
 public:
  static constexpr int kBurst = 3, kPause = 150;

  /// What arrived since the last call; asked before every frame, on the thread of `process`. Empty: no commands.
  using Inbox = std::function<std::vector<Result<Command>>()>;

  /// `workers` and `log` outlive the tracker.
  CommandedTracker(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::uint64_t seed,
                   Workers& workers, Inbox inbox, RepeatLog& log);

  HandEstimatePtr process(const HandObservation& observation);
  void start_at(const HandPose& pose) { tracker_->start_at(pose); }
  /// See HandTracker::change.
  void change(const TrackerParams& params) {
    params_ = params;
    tracker_->change(params);
  }

 private:
  void collect(const std::string& sensor);
  void follow_waiting();
  bool concerns(const Command& command, const std::string& sensor) const;
  void follow(const Command& command);
  void use(std::shared_ptr<const HandProfile> profile);

  TrackerParams params_;
  const std::uint64_t seed_;
  Workers& workers_;
  const Inbox inbox_;
  RepeatLog& log_;
  std::unique_ptr<HandTracker> tracker_;
  std::int32_t hand_id_ = 0;
  std::vector<Command> waiting_;  // one of each kind at most, oldest first
  int allowed_ = kBurst;          // frames on which commands may be followed
  int frames_ = 0;
};

}  // namespace barehand
