// Reads stated grasps from a log of hand states.
#include "app/eval/stated_grasps.h"

#include <optional>

#include "barehand/grasp_state_t.hpp"
#include "drivers/lcm/logged_messages.h"

namespace barehand {

Result<StatedGrasps> read_stated_grasps(const std::string& log_path) {
  auto log = MessageLog::open(log_path);
  if (!log) return tl::unexpected(log.error());
  StatedGrasps grasps;
  std::optional<std::int8_t> side;

  // Read every message that states a grasp.
  const auto read = visit_messages<grasp_state_t>(*log, [&](const grasp_state_t& state) -> Result<void> {
    // A truth is that of one hand.
    if (state.handedness != side.value_or(state.handedness))
      return fail("holds the grasps of two hands, and a truth is one hand's", log_path,
                  "track the hand alone: --hand right or --hand left");
    side = state.handedness;

    const bool known = state.grasp >= 0 && state.grasp < kGraspCount && state.kind >= 0 &&
                       state.kind <= static_cast<int>(GraspKind::precision) && state.probability >= 0 &&
                       state.probability <= 1;
    grasps[state.utime] =
        known ? StatedGrasp{true, state.grasp, state.probability, GraspKind(state.kind)} : StatedGrasp{};
    return {};
  });
  if (!read) return tl::unexpected(read.error());

  // Refuse a log without grasps.
  if (grasps.empty())
    return fail("holds no grasps", log_path,
                "give a log written by barehand track --states-log or --mcap with grasp.enabled: true");
  return grasps;
}

}  // namespace barehand
