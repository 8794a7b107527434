#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace barehand {

/// Parameters of a run of `barehand track` that do not belong to a stage. Settings that change no result (threads,
/// outputs) are options of the command line instead.
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
  // These settings are for the run as a whole.
  v.user("seed", p.seed, 0, std::numeric_limits<std::int64_t>::max(),
         "seed of the random numbers: runs with the same seed give the same results");
  v("max_failures_in_a_row", p.max_failures_in_a_row, 1, 1000000,
    "consecutive frames that one stage may fail on before the run ends; outputs of a live run may fail without limit");
  v.user("health_period", p.health_period, 0.05, 3600.0, "s, interval between two health messages");

  // These settings are for the exchange of messages on LCM.
  v.user(
      "channel_prefix", p.channel_prefix,
      "prefix of the names of all LCM channels that are published; several sensors on one network need different ones");
  v.user("frame_channel", p.frame_channel,
         "LCM channel with frames, of one camera (* and ? stand for other characters); empty: live the first channel "
         "matching *RGBD_FRAME that brings a frame, in a log the only channel with frames");

  // These settings say how far messages travel, and whether commands from the network are executed.
  v.user("lcm_ttl", p.lcm_ttl, 0, 255,
         "how far messages travel: 0 this machine, 1 the local network, more through routers; a ttl in the LCM URL "
         "takes precedence");
  v.user("commands", p.commands, "execute the commands that anyone on the network sends (channel COMMAND)");
}

}  // namespace barehand
