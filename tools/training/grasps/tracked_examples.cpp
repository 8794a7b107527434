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

#include "tools/training/grasps/example_file.h"
#include "tools/training/grasps/logged_estimate.h"

namespace {

using namespace barehand;

Result<void> write_examples(const std::string& path, int number, std::ofstream& out) {
  std::optional<std::int64_t> first;
  return visit_hands(path, [&](const LoggedHand& hand) -> Result<void> {
    if (!first) first = hand.state.utime;
    if (hand.state.status != hand_state_t::TRACKING) return {};
    const double seconds = 1e-6 * static_cast<double>(hand.state.utime - *first);
    const SegmentContacts* objects = hand.contacts ? &hand.contacts->hands[0].object : nullptr;
    write_example(out, number, seconds, grasp_features(hand.estimate, objects));
    return {};
  });
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
