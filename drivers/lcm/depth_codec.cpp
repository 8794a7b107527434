// Encodes and decodes the depth images of rgbd_frame_t without loss.
#include "drivers/lcm/depth_codec.h"

#include <zlib.h>
#include <zstd.h>

#include <bit>
#include <cassert>
#include <cstring>
#include <string>

#include "drivers/lcm/rvl.h"

namespace barehand {
namespace {

static_assert(std::endian::native == std::endian::little, "raw depth is copied as it lies in memory");

using Bytes = std::vector<std::uint8_t>;
using Depth = Image<std::uint16_t>;

std::span<const std::uint8_t> raw(const Depth& depth) {
  return {reinterpret_cast<const std::uint8_t*>(depth.data()), 2 * depth.size()};
}

Bytes deflated(std::span<const std::uint8_t> bytes) {
  uLongf size = compressBound(bytes.size());
  Bytes code(size);
  [[maybe_unused]] const int status = compress2(code.data(), &size, bytes.data(), bytes.size(), Z_BEST_SPEED);
  assert(status == Z_OK && "the buffer has the size that zlib asks for");
  code.resize(size);
  return code;
}

Bytes zstd_compressed(const Bytes& bytes) {
  Bytes code(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(code.data(), code.size(), bytes.data(), bytes.size(), 1);
  assert(!ZSTD_isError(size) && "the buffer has the size that zstd asks for");
  code.resize(size);
  return code;
}

Result<void> inflate_into(std::span<const std::uint8_t> code, Depth& depth) {
  const uLongf expected = 2 * depth.size();
  uLongf size = expected, used = code.size();
  const int status = uncompress2(reinterpret_cast<Bytef*>(depth.data()), &size, code.data(), &used);
  if (status != Z_OK) return fail("damaged zlib depth");
  if (size != expected)
    return fail("zlib depth holds " + std::to_string(size) + " bytes, expected " + std::to_string(expected));
  if (used != code.size()) return fail("zlib depth is followed by other data");
  return {};
}

Result<void> rvl_zstd_into(std::span<const std::uint8_t> code, Depth& depth) {
  const unsigned long long stated = ZSTD_getFrameContentSize(code.data(), code.size());
  if (stated == ZSTD_CONTENTSIZE_ERROR || stated == ZSTD_CONTENTSIZE_UNKNOWN || stated > rvl_bound(depth.size())) {
    return fail("damaged zstd depth");
  }
  Bytes rvl(stated);
  const std::size_t size = ZSTD_decompress(rvl.data(), rvl.size(), code.data(), code.size());
  if (ZSTD_isError(size) || size != stated) return fail("damaged zstd depth");
  return rvl_decode(rvl, {depth.data(), depth.size()});
}

Result<void> decode_into(std::span<const std::uint8_t> bytes, DepthEncoding encoding, Depth& depth) {
  switch (encoding) {
    // Raw depth is copied as it lies in memory, so its size must be that of the image.
    case DepthEncoding::raw16:
      if (bytes.size() != 2 * depth.size()) {
        return fail("raw depth holds " + std::to_string(bytes.size()) + " bytes, expected " +
                    std::to_string(2 * depth.size()));
      }
      std::memcpy(depth.data(), bytes.data(), bytes.size());
      return {};

    // Compressed depth is checked by its decoder.
    case DepthEncoding::zlib:
      return inflate_into(bytes, depth);
    case DepthEncoding::rvl_zstd:
      return rvl_zstd_into(bytes, depth);
  }
  return fail("unknown depth encoding " + std::to_string(static_cast<int>(encoding)));
}

}  // namespace

Bytes encode_depth(const Depth& depth, DepthEncoding encoding) {
  switch (encoding) {
    case DepthEncoding::raw16:
      return Bytes(raw(depth).begin(), raw(depth).end());
    case DepthEncoding::zlib:
      return deflated(raw(depth));
    case DepthEncoding::rvl_zstd:
      return zstd_compressed(rvl_encode({depth.data(), depth.size()}));
  }
  assert(false && "every encoding is handled");
  return {};
}

Result<void> check_image_size(std::int64_t width, std::int64_t height) {
  if (possible_size(width, height)) return {};
  return fail("impossible image size " + std::to_string(width) + "x" + std::to_string(height));
}

Result<Depth> decode_depth(std::span<const std::uint8_t> bytes, DepthEncoding encoding, int width, int height) {
  if (auto size = check_image_size(width, height); !size) return tl::unexpected(size.error());
  // Check first that there are enough bytes, since deflate compresses by at most 1032:1: a message of a few bytes must
  // not make the program allocate a large image.
  const bool too_little =
      encoding == DepthEncoding::zlib && static_cast<double>(bytes.size()) * 1040 < 2.0 * width * height;
  if (bytes.empty() || too_little)
    return fail("too little depth data for " + std::to_string(width) + "x" + std::to_string(height));
  Depth depth(width, height);
  if (auto decoded = decode_into(bytes, encoding, depth); !decoded) return tl::unexpected(decoded.error());
  return depth;
}

}  // namespace barehand
