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
  std::string sensor;                   ///< name of the sensor that is addressed; "": every sensor
  std::optional<std::int32_t> hand_id;  ///< the hand that is addressed; none: every hand
  HandPose pose;                        ///< for initialise: T_camera_segment of every segment
  std::string profile;                  ///< for set_profile: the text of a hand.json
};

/// Longest hand profile that a command may carry [bytes]; real profiles have a few thousand.
inline constexpr std::size_t kLongestProfile = 1u << 20;

/// Decodes a command_t. Errors: a damaged message, an unknown kind, a pose that is not a rigid transform within 100 m,
/// a profile that is too long, or set_profile without one.
Result<Command> decode_command(WireBytes message);

/// Collects the commands that arrive on a bus until they are taken. At most `kCapacity` of them wait; when more arrive,
/// the oldest are dropped, since the newest are the ones that still apply.
class CommandInbox {
 public:
  static constexpr std::size_t kCapacity = 16;

  /// `channels` is a glob (matches_glob) such as "*COMMAND".
  CommandInbox(std::shared_ptr<LcmBus> bus, const std::string& channels);

  /// The commands that arrived since the last call, oldest first. A command that could not be decoded is an error in
  /// the list.
  std::vector<Result<Command>> take();

 private:
  std::mutex mutex_;  ///< guards `waiting_`
  std::vector<Result<Command>> waiting_;
  LcmListener listener_;  ///< declared last: its thread uses the members above
};

}  // namespace barehand
