#include "evaluation/evaluation.h"
#include "fuzz/memory_file.h"

/// Input: a truth or result table, which is compared with itself.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const fuzz::MemoryFile file(data, size);
  const auto table = read_table(file.path());
  if (!table) return 0;
  for (const std::int64_t step : {1, -2})
    if (const auto evaluation = evaluate(*table, *table, {std::nullopt, step}))
      CHECK(evaluation->frame_error.count == 0 || evaluation->frame_error.max == 0);
  return 0;
}
