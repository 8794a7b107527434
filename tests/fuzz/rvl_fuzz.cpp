#include "drivers/lcm/rvl.h"

#include "fuzz/check.h"

/// Input: depth in the RVL code, as it is before compression by zstd. The first two bytes are the number of pixels.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  if (size < 2) return 0;
  std::vector<std::uint16_t> counts(1 + (data[0] << 8 | data[1]) % 4096), again(counts.size());
  if (!rvl_decode({data + 2, size - 2}, counts)) return 0;
  const auto code = rvl_encode(counts);
  CHECK(code.size() <= rvl_bound(counts.size()));
  CHECK(rvl_decode(code, again).has_value() && again == counts);
  return 0;
}
