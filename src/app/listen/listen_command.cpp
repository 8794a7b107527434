// The command `barehand listen`, which prints the states of hands and objects that it receives over LCM.
#include "app/listen/listen_command.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include "app/listen/state_line.h"
#include "app/shared/exit_code.h"
#include "app/shared/interrupt.h"
#include "app/shared/standard_streams.h"
#include "drivers/lcm/lcm_listener.h"

namespace barehand {
namespace {

struct ListenOptions {
  std::string url, prefix;
  std::int64_t count = 0;
};

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
                               std::puts(state_line(channel, message).c_str());
                               std::fflush(stdout);
                               ++seen;
                             });
  while (!stop && !output_is_closed() && !listener.broken() && (options.count == 0 || seen < options.count)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (output_is_closed()) return kExitBrokenPipe;
  if (listener.broken() && options.url.starts_with("file://")) return printed(kExitOk);  // the log has ended
  if (listener.broken()) {
    std::cerr << "barehand listen: the LCM connection broke\n";
    return kExitFailure;
  }
  return printed(interrupt.signal() == SIGINT ? kExitInterrupted : kExitOk);
}

}  // namespace

void add_listen_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ListenOptions>();
  CLI::App* command =
      app.add_subcommand("listen", "Print what trackers send on LCM: hands, gloves, grasps, contacts and objects");
  command->add_option("--lcm-url", options->url, "LCM network");
  command->add_option("--prefix", options->prefix, "channel prefix of the tracker");
  command->add_option("--count", options->count, "stop after this many messages")->check(CLI::Range(1, 1'000'000'000));
  command->callback([options, &exit_code] { exit_code = listen(*options); });
}

}  // namespace barehand
