// Writes the features of all tracked hands in logs of hand states for the training of the grasp classifier, so that it
// learns from the very numbers that the program computes.
//
//   tracked_examples OUT LOG...
//
// Each row (example_file.h) begins with the number of the log in the command, from 0, and the seconds since the first
// state of that log.
#include <cstdio>
#include <fstream>
#include <optional>

#include "drivers/lcm/layouts.h"
#include "io/lcm/message_log.h"
#include "tools/training/grasps/example_file.h"
#include "tools/training/grasps/logged_estimate.h"

namespace {

using namespace barehand;

Result<void> write_examples(const std::string& path, int number, std::ofstream& out) {
  auto log = MessageLog::open(path);
  if (!log) return tl::unexpected(log.error());
  std::optional<std::int64_t> first;
  for (const LogEntry& entry : log->entries()) {
    if (entry.hash != hand_state_t::getHash()) continue;
    const auto bytes = log->read(entry);
    if (!bytes) return tl::unexpected(bytes.error());
    const auto state = decode_message<hand_state_t>(*bytes);
    if (!state) continue;
    if (!first) first = state->utime;
    if (state->status != hand_state_t::TRACKING) continue;

    write_example(out, number, 1e-6 * static_cast<double>(state->utime - *first), grasp_features(estimate_of(*state)));
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: tracked_examples OUT LOG...\n");
    return 2;
  }
  std::ofstream out(argv[1], std::ios::binary);
  for (int i = 2; i < argc; ++i)
    if (const auto written = write_examples(argv[i], i - 2, out); !written) {
      std::fprintf(stderr, "tracked_examples: %s\n", written.error().message().c_str());
      return 1;
    }
  if (out.flush()) return 0;
  std::fprintf(stderr, "tracked_examples: %s cannot be written\n", argv[1]);
  return 1;
}
