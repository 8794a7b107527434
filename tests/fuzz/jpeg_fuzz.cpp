#include "fuzz/check.h"
#include "io/recording/image_codec.h"

/// Input: a colour image of at most a megapixel. Decoding the largest ones takes a second with the sanitizers and tests
/// nothing else.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const std::span bytes(data, size);
  const auto stated = compressed_image_size(bytes);
  if (!stated || stated->width * stated->height > 1 << 20) return 0;
  const auto colour = decode_image(bytes, *stated);
  if (colour) CHECK(colour->width() == stated->width && colour->height() == stated->height);
  return 0;
}
