#include <zlib.h>

#include <cstring>

#include "fuzz/memory_file.h"
#include "io/image_codec.h"
#include "io/image_file.h"

namespace {

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 | bytes[3];
}

/// Makes the check sums of a PNG right, or the decoder would throw away almost every mutation at once.
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

// libFuzzer's; replay.cpp has none, and calls no mutator.
extern "C" [[gnu::weak]] std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned) {
  size = LLVMFuzzerMutate(data, size, max_size);
  if (size > 8 && data[0] == 0x89) mend_checksums(data, size);
  return size;
}

/// A depth or a colour image in a file, PNG or JPEG.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const fuzz::MemoryFile file(data, size);
  if (const auto depth = read_depth_png(file.path())) CHECK(depth->size() > 0);
  const auto colour = read_colour(file.path());
  if (!colour) return 0;
  const auto stated = compressed_image_size({data, size});
  CHECK(stated && colour->width() == stated->width && colour->height() == stated->height);
  return 0;
}
