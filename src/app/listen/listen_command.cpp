// The command `barehand listen`, which prints the hand states that it receives over LCM.
#include "app/listen/listen_command.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include "app/shared/exit_code.h"
#include "app/shared/interrupt.h"
#include "app/shared/standard_streams.h"
#include "drivers/lcm/layouts.h"
#include "drivers/lcm/lcm_listener.h"
#include "hand/status_name.h"
#include "math/angles.h"

namespace barehand {
namespace {

struct ListenOptions {
  std::string url, prefix;
  std::int64_t count = 0;
};

const char* status_text(int status) {
  return status >= 0 && status < 4 ? to_string(static_cast<TrackStatus>(status)).data() : "?";
}

/// Prints one line: frame, hand, status and, if there is a pose, the palm's position [m] and confidence.
void print_state(const hand_state_t& m) {
  std::printf("frame %lld  %s hand %d  %-9s", static_cast<long long>(m.frame_number),
              m.handedness == hand_state_t::LEFT ? "left" : "right", m.hand_id, status_text(m.status));
  const segment_state_t& palm = m.segments[0];
  if (m.has_pose) {
    std::printf("  palm %7.3f %7.3f %7.3f m  confidence %.2f", palm.position[0], palm.position[1], palm.position[2],
                palm.confidence);
  }
  std::printf("\n");
}

void print_glove(const glove_state_t& m) {
  std::printf("frame %lld  flexion of knuckles [deg]", static_cast<long long>(m.frame_number));
  for (const int channel : {glove_state_t::THUMB_MPJ, glove_state_t::INDEX_MPJ, glove_state_t::MIDDLE_MPJ,
                            glove_state_t::RING_MPJ, glove_state_t::PINKIE_MPJ}) {
    std::printf(" %5.0f", m.channel[channel] / kDegree);
  }
  std::printf("\n");
}

void print(const std::string& channel, WireBytes message) {
  if (const auto state = decode_message<hand_state_t>(message)) return print_state(*state);
  if (const auto glove = decode_message<glove_state_t>(message)) return print_glove(*glove);
  std::printf("%s: %zu bytes of another type\n", channel.c_str(), message.size());
}

int listen(const ListenOptions& options) {
  std::atomic<bool> stop = false;
  const InterruptWatcher interrupt([&stop] { stop = true; });
  auto bus = LcmBus::open(options.url);
  if (!bus) {
    std::cerr << "barehand listen: " << bus.error().message() << "\n";
    return kExitUsage;
  }
  std::cerr << "listening on " << (*bus)->url() << "\n";
  std::atomic<std::int64_t> seen = 0;
  const LcmListener listener(std::move(*bus), options.prefix + "*_STATE",
                             [&](const std::string& channel, WireBytes message) {
                               if (options.count > 0 && seen >= options.count) return;
                               print(channel, message);
                               std::fflush(stdout);
                               ++seen;
                             });
  while (!stop && !output_is_closed() && !listener.broken() && (options.count == 0 || seen < options.count)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (listener.broken()) std::cerr << "barehand listen: the LCM connection broke\n";
  if (output_is_closed()) return kExitBrokenPipe;
  if (listener.broken()) return kExitFailure;
  return printed(interrupt.signal() == SIGINT ? kExitInterrupted : kExitOk);
}

}  // namespace

void add_listen_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ListenOptions>();
  CLI::App* command = app.add_subcommand("listen", "Print hand and glove states from LCM");
  command->add_option("--lcm-url", options->url, "LCM network");
  command->add_option("--prefix", options->prefix, "channel prefix of the tracker");
  command->add_option("--count", options->count, "stop after this many messages")->check(CLI::PositiveNumber);
  command->callback([options, &exit_code] { exit_code = listen(*options); });
}

}  // namespace barehand
