#include <cmath>
#include <string>

#include "fuzz/check.h"
#include "fuzz/memory_file.h"
#include "io/hand/hand_json.h"

/// Input: a file hand.json. An accepted one must be a valid hand profile, which can be written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const auto profile = parse_profile({reinterpret_cast<const char*>(data), size}, "input");
  if (!profile) return 0;
  for (const SegmentProfile& segment : profile->segments)
    CHECK(segment.distal.allFinite() && segment.T_hand_segment.t.allFinite() && segment.T_hand_segment.R.allFinite());
  const fuzz::MemoryFile file("", 0);
  CHECK(save_profile(*profile, file.path()).has_value());
  CHECK(load_profile(file.path()).has_value());
  return 0;
}
