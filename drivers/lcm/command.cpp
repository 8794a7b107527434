// Decodes the commands that a running tracker receives over LCM.
#include "drivers/lcm/command.h"

#include <cmath>

#include "drivers/lcm/layouts.h"

namespace barehand {
namespace {

constexpr double kFarthest = 100;  // largest coordinate of a segment [m], as in a pose file

Result<HandPose> pose_of(const command_t& message) {
  HandPose pose;
  for (int s = 0; s < kSegmentCount; ++s) {
    const auto& p = message.position[s];
    const auto& q = message.orientation[s];  // quaternion (w, x, y, z)
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);

    // Accept only a finite position near the camera, and a quaternion that can be normalised.
    pose[s].t = Eigen::Vector3d(p[0], p[1], p[2]);
    const bool near = pose[s].t.cwiseAbs().maxCoeff() <= kFarthest && pose[s].t.allFinite();
    if (!near || !std::isfinite(turn.norm()) || turn.norm() <= 1e-6)
      return fail("the pose of " + std::string(kSegmentNames[s]) + " is not a rigid transform within " +
                      std::to_string(static_cast<int>(kFarthest)) + " m",
                  "command");
    pose[s].R = turn.normalized().toRotationMatrix();
  }
  return pose;
}

}  // namespace

Result<Command> decode_command(WireBytes bytes) {
  const auto message = decode_message<command_t>(bytes);
  if (!message) return tl::unexpected(message.error());
  if (message->command < command_t::RESET || message->command > command_t::SET_PROFILE) {
    return fail("unknown command " + std::to_string(message->command), "command");
  }

  // Copy the fields that every command has.
  Command command;
  command.kind = static_cast<Command::Kind>(message->command);
  command.utime = message->utime;
  command.sensor = message->sensor;
  if (message->hand_id != command_t::ANY_HAND) command.hand_id = message->hand_id;

  // Check the hand profile before it is copied.
  if (command.kind == Command::Kind::set_profile && message->profile.empty()) {
    return fail("the hand profile is empty", "command");
  }
  if (message->profile.size() > kLongestProfile) {
    return fail("the hand profile has " + std::to_string(message->profile.size()) + " bytes", "command",
                "give at most " + std::to_string(kLongestProfile));
  }
  command.profile = message->profile;

  // Only a command that initialises a hand carries a pose.
  if (command.kind == Command::Kind::initialise) {
    auto pose = pose_of(*message);
    if (!pose) return tl::unexpected(pose.error());
    command.pose = *pose;
  }
  return command;
}

CommandInbox::CommandInbox(std::shared_ptr<LcmBus> bus, const std::string& channels)
    : listener_(std::move(bus), channels, [this](const std::string&, WireBytes message) {
        Result<Command> command = decode_command(message);
        const std::lock_guard lock(mutex_);
        if (waiting_.size() == kCapacity) waiting_.erase(waiting_.begin());
        waiting_.push_back(std::move(command));
      }) {}

std::vector<Result<Command>> CommandInbox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(waiting_, {});
}

}  // namespace barehand
