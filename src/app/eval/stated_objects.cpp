// Reads stated poses of a known object from a log of hand states.
#include "app/eval/stated_objects.h"

#include <cmath>

#include "barehand/object_state_t.hpp"
#include "drivers/lcm/logged_messages.h"

namespace barehand {
namespace {

constexpr std::int32_t kFirst = 1;  // id of the first known object
constexpr double kUnit = 1e-3;      // deviation of a unit quaternion's norm from 1

}  // namespace

Result<ObjectPoses> read_stated_objects(const std::string& log_path) {
  auto log = MessageLog::open(log_path);
  if (!log) return tl::unexpected(log.error());
  ObjectPoses poses;

  // Read the messages about the first object, and leave out those that hold no rigid motion.
  const auto read = visit_messages<object_state_t>(*log, [&](const object_state_t& state) -> Result<void> {
    if (state.object_id != kFirst) return {};

    const double* q = state.orientation;
    const Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
    const Eigen::Vector3d position(state.position);
    const bool is_pose = position.allFinite() && std::abs(orientation.norm() - 1) < kUnit;
    if (!is_pose) return {};
    poses[state.utime] = {orientation.normalized().toRotationMatrix(), position};
    return {};
  });
  if (!read) return tl::unexpected(read.error());
  return poses;
}

}  // namespace barehand
