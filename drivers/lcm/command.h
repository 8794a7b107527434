#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "drivers/lcm/lcm_listener.h"
#include "hand/hand_pose.h"

namespace barehand {

/// A request to a running tracker.
struct Command {
  enum class Kind { reset = 1, initialise = 2, set_profile = 3 };
  Kind kind = Kind::reset;
  std::int64_t utime = 0;
  std::string sensor;                   ///< "": every sensor
  std::optional<std::int32_t> hand_id;  ///< not given: every hand
  HandPose pose;                        ///< initialise: T_camera_segment
  std::string profile;                  ///< set_profile: the text of a hand.json
};

/// Longest hand profile that a command may carry [bytes]; a real one has a few thousand.
inline constexpr std::size_t kLongestProfile = 1u << 20;

/// The command in an encoded command_t. An unknown kind, a pose that is not a rigid transform within 100 m and a
/// profile that is empty or too long are errors.
Result<Command> decode_command(WireBytes message);

/// Collects the commands that arrive on a bus until they are taken. At most `kCapacity` wait; then the oldest go, as
/// the newest say what is wanted now.
class CommandInbox {
 public:
  static constexpr std::size_t kCapacity = 16;

  /// `channels` is a glob: "*COMMAND".
  CommandInbox(std::shared_ptr<LcmBus> bus, const std::string& channels);

  /// What arrived since the last call, oldest first; what could not be read comes as an error.
  std::vector<Result<Command>> take();

 private:
  std::mutex mutex_;  ///< guards `waiting_`
  std::vector<Result<Command>> waiting_;
  LcmListener listener_;  ///< last: its thread uses the above
};

}  // namespace barehand
