#include "evaluation/fingertips.h"
#include "fuzz/memory_file.h"

/// Input: a file of labelled fingertips, which is read and evaluated.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const fuzz::MemoryFile file(data, size);
  const auto labels = read_fingertip_labels(file.path());
  if (!labels) return 0;
  for (const FingertipLabel& label : *labels) CHECK(label.finger >= 0 && label.finger < kFingerCount);

  // Evaluate the labels against a hand that is tracked in all of their frames.
  ResultTable hand;  // has a hand in every frame that has labels
  for (const FingertipLabel& label : *labels) {
    hand.frames.push_back({label.frame, 0, {}});
    for (TableRow& row : hand.frames.back().rows) row = {{0, 0, 0.5}, {-0.03, 0, 0.5}, 1};
  }
  const auto evaluation = evaluate_fingertips(*labels, {hand}, {}, {640, 480, 500, 500, 320, 240});
  CHECK(evaluation.labels == labels->size() && evaluation.missing == 0);
  CHECK(labels->empty() || evaluation.all.min <= evaluation.all.max);
  return 0;
}
