#include "fuzz/message.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  barehand::fuzz::decode<barehand::hand_joints_t>(data, size);
  return 0;
}
