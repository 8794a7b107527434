#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace barehand {

/// How `barehand track` runs, apart from the method. What changes no result (threads, outputs) is an option of the
/// command instead.
struct RunParams {
  std::int64_t seed = 1;
  int max_failures_in_a_row = 30;
  double health_period = 1.0;
  std::string channel_prefix = "";
  std::string frame_channel = "";
  int lcm_ttl = 0;
  bool commands = false;
};
template <class V>
void visit(V& v, RunParams& p) {
  v.user("seed", p.seed, 0, std::numeric_limits<std::int64_t>::max(), "of the random numbers: same seed, same results");
  v("max_failures_in_a_row", p.max_failures_in_a_row, 1, 1000000,
    "frames one stage may fail on before the run ends; outputs of a live run may fail for ever");
  v.user("health_period", p.health_period, 0.05, 3600.0, "s between two health messages");
  v.user("channel_prefix", p.channel_prefix,
         "before the names of all LCM channels that are published; one for each sensor of a network");
  v.user("frame_channel", p.frame_channel,
         "LCM channels with frames (a pattern with * and ?); empty: live the first of *RGBD_FRAME that brings one, in "
         "a log "
         "the only one that has some");
  v.user("lcm_ttl", p.lcm_ttl, 0, 255,
         "how far messages go: 0 this machine, 1 the local network, more through routers; a ttl in the LCM URL goes "
         "before");
  v.user("commands", p.commands, "follow whoever on the network sends commands (channel COMMAND)");
}

}  // namespace barehand
