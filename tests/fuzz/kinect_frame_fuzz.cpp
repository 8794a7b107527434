#include "fuzz/frame.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  barehand::fuzz::frame_from<kinect::frame_msg_t>(data, size);
  return 0;
}
