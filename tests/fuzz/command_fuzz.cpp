#include "drivers/lcm/command.h"
#include "fuzz/message.h"
#include "io/hand/hand_json.h"

/// Input: a command message. It is decoded and checked, but not executed by a tracker.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  fuzz::decode<command_t>(data, size);
  const auto command = decode_command(fuzz::message_of<command_t>(data, size));
  if (!command) return 0;
  if (command->kind == Command::Kind::set_profile) static_cast<void>(parse_profile(command->profile, "command"));
  if (command->kind == Command::Kind::initialise)
    for (int s = 0; s < kSegmentCount; ++s) {
      CHECK(command->pose[s].t.allFinite());
      CHECK((command->pose[s].R * command->pose[s].R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-9);
    }
  return 0;
}
