// Executes commands between the frames of a tracker.
#include "tracking/commanded_tracker.h"

#include <algorithm>
#include <utility>

#include "hand/profile_warnings.h"
#include "io/hand/hand_json.h"

namespace barehand {

CommandedTracker::CommandedTracker(const TrackerParams& params, const TwoHandTracker::Profiles& profiles,
                                   std::uint64_t seed, Workers& workers, Inbox inbox, RepeatLog& log,
                                   Slot<TrackerParams>* changed)
    : inbox_(std::move(inbox)),
      log_(log),
      changed_(changed),
      tracker_(params, profiles, seed, workers, log.shared_logger()) {}

Result<HandEstimates> CommandedTracker::process(HandObservations& observations) {
  // Take changed parameters and new commands.
  if (const auto params = changed_ ? changed_->take() : std::nullopt) tracker_.change(*params);
  if (inbox_) collect(observations[0]->frame->sensor);

  // Execute the waiting commands if the limit allows it, then track.
  if (++frames_ % kPause == 0) allowed_ = std::min(allowed_ + 1, kBurst);
  if (allowed_ > 0 && !waiting_.empty()) follow_waiting();
  return last_ = tracker_.process(observations);
}

void CommandedTracker::collect(const std::string& sensor) {
  for (Result<Command>& command : inbox_()) {
    if (!command) {
      log_.warn("command", "ignored a command: " + command.error().message());
    } else if ((command->sensor.empty() || command->sensor == sensor) && !concerned(*command).empty()) {
      if (!make_room_for(*command))
        log_.warn("commands", "commands arrive faster than they are executed; only the newest of each kind is");
      waiting_.push_back(std::move(*command));
    }
  }
}

/// Removes the oldest waiting command of this kind and hand if there are too many. Returns whether none was removed.
bool CommandedTracker::make_room_for(const Command& command) {
  const auto is_same = [&](const Command& c) { return c.kind == command.kind && c.hand_id == command.hand_id; };
  const bool one_a_side = command.kind == Command::Kind::set_profile && !command.hand_id;
  const auto most = one_a_side ? tracker_.count() : 1;
  if (std::count_if(waiting_.begin(), waiting_.end(), is_same) < most) return true;
  waiting_.erase(std::find_if(waiting_.begin(), waiting_.end(), is_same));
  return false;
}

void CommandedTracker::follow_waiting() {
  --allowed_;
  for (const Command& command : std::exchange(waiting_, {})) follow(command);
}

std::vector<int> CommandedTracker::concerned(const Command& command) const {
  std::vector<int> hands;
  for (int k = 0; k < tracker_.count(); ++k)
    if (!command.hand_id || *command.hand_id == (last_.empty() ? 0 : last_[k]->hand_id)) hands.push_back(k);
  return hands;
}

void CommandedTracker::follow(const Command& command) {
  const std::vector<int> hands = concerned(command);
  if (hands.empty()) return;
  if (command.kind == Command::Kind::reset) {
    log_.logger().info("command: forget the hand and search again");
    for (const int k : hands) tracker_.reset(k);
  } else if (command.kind == Command::Kind::initialise) {
    if (hands.size() > 1)
      return log_.warn("command", "ignored a pose: two hands are tracked, so the command must name one");
    log_.logger().info("command: track from the given pose");
    tracker_.start_at(hands[0], command.pose);
  } else {
    // Use the given profile from now on, and warn of what is implausible about it.
    auto profile = parse_profile(command.profile, "command");
    if (!profile) return log_.warn("command", "ignored a hand profile: " + profile.error().message());
    for (const std::string& warning : profile_warnings(*profile))
      log_.warn("profile", "the given hand profile: " + warning);
    use(hands, std::move(*profile));
  }
}

void CommandedTracker::use(const std::vector<int>& hands, HandProfile profile) {
  for (const int k : hands) {
    if (tracker_.count() > 1 && tracker_.view(k).profile->handedness != profile.handedness) continue;
    log_.logger().info("command: use the given hand profile");
    return tracker_.use(k, std::make_shared<const HandProfile>(std::move(profile)));
  }
  log_.warn("command", "ignored a hand profile: its handedness differs from that of the hand it is meant for");
}

}  // namespace barehand
