#include "fuzz/frame.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  barehand::fuzz::frame_from<barehand::rgbd_frame_t>(data, size);
  return 0;
}
