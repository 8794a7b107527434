#include "app/commanded_tracker.h"

#include <algorithm>
#include <utility>

#include "io/hand_json.h"

namespace barehand {

CommandedTracker::CommandedTracker(const TrackerParams& params, std::shared_ptr<const HandProfile> profile,
                                   std::uint64_t seed, Workers& workers, Inbox inbox, RepeatLog& log)
    : params_(params), seed_(seed), workers_(workers), inbox_(std::move(inbox)), log_(log) {
  use(std::move(profile));
}

HandEstimatePtr CommandedTracker::process(const HandObservation& observation) {
  if (inbox_) collect(observation.frame->sensor);
  if (++frames_ % kPause == 0) allowed_ = std::min(allowed_ + 1, kBurst);
  if (allowed_ > 0 && !waiting_.empty()) follow_waiting();
  HandEstimatePtr estimate = tracker_->process(observation);
  hand_id_ = estimate->hand_id;
  return estimate;
}

void CommandedTracker::collect(const std::string& sensor) {
  for (Result<Command>& command : inbox_()) {
    if (!command) {
      log_.warn("command", "ignored a command: " + command.error().message());
    } else if (concerns(*command, sensor)) {
      const auto replaced = std::erase_if(waiting_, [&](const Command& c) { return c.kind == command->kind; });
      if (replaced > 0)
        log_.warn("commands", "commands come faster than they are followed; the newest of a kind counts");
      waiting_.push_back(std::move(*command));
    }
  }
}

void CommandedTracker::follow_waiting() {
  --allowed_;
  for (const Command& command : std::exchange(waiting_, {})) follow(command);
}

bool CommandedTracker::concerns(const Command& command, const std::string& sensor) const {
  return (command.sensor.empty() || command.sensor == sensor) && (!command.hand_id || *command.hand_id == hand_id_);
}

void CommandedTracker::follow(const Command& command) {
  if (command.kind == Command::Kind::reset) {
    log_.logger().info("command: forget the hand and search again");
    tracker_->reset();
  } else if (command.kind == Command::Kind::initialise) {
    log_.logger().info("command: track from the given pose");
    tracker_->start_at(command.pose);
  } else {
    auto profile = parse_profile(command.profile, "command");
    if (!profile) return log_.warn("command", "ignored a hand profile: " + profile.error().message());
    log_.logger().info("command: use the given hand profile");
    use(std::make_shared<const HandProfile>(std::move(*profile)));
  }
}

void CommandedTracker::use(std::shared_ptr<const HandProfile> profile) {
  tracker_ = std::make_unique<HandTracker>(params_, std::move(profile), seed_, workers_, log_.shared_logger());
}

}  // namespace barehand
