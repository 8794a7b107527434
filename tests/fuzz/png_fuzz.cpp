#include <zlib.h>

#include <algorithm>

#include "fuzz/check.h"
#include "io/recording/image_codec.h"
#include "io/recording/png_codec.h"

namespace {

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 | bytes[3];
}

/// Corrects the checksums of a PNG, since the decoder would reject almost every mutation otherwise.
void mend_checksums(std::uint8_t* data, std::size_t size) {
  for (std::size_t at = 8; at + 12 <= size;) {
    const std::size_t length = big_endian(data + at);
    if (length > size - at - 12) return;
    const auto sum = static_cast<std::uint32_t>(crc32(0, data + at + 4, static_cast<uInt>(length + 4)));
    for (int i = 0; i < 4; ++i) data[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    at += 12 + length;
  }
}

}  // namespace

// libFuzzer's own mutator. It is missing (null) in programs with replay.cpp, which never call a mutator.
extern "C" [[gnu::weak]] std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned) {
  size = LLVMFuzzerMutate(data, size, max_size);
  if (size > 8 && data[0] == 0x89) mend_checksums(data, size);
  return size;
}

/// Input: a depth or colour image. An accepted one must be the same after encoding and decoding it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const std::span bytes(data, size);

  // A depth image must survive being encoded and decoded again.
  if (const auto depth = decode_depth_image(bytes)) {
    const auto again = decode_depth_image(encode_png(*depth).value()).value();
    CHECK(std::equal(again.data(), again.data() + again.size(), depth->data(), depth->data() + depth->size()));
  }

  // So must a colour image.
  const auto stated = compressed_image_size(bytes);
  if (!stated) return 0;
  const auto colour = decode_image(bytes, *stated);
  if (!colour) return 0;
  CHECK(colour->width() == stated->width && colour->height() == stated->height);
  const auto again = decode_image(encode_png(*colour).value(), *stated).value();
  CHECK(std::equal(again.data(), again.data() + again.size(), colour->data(), colour->data() + colour->size()));
  return 0;
}
