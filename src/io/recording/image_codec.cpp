// Decodes PNG and JPEG images in memory, after a check of their size.
#include "io/recording/image_codec.h"

#include <algorithm>
#include <array>

#include "io/recording/jpeg_codec.h"
#include "io/recording/png_codec.h"
#include "sensor/camera_limits.h"

namespace barehand {
namespace {

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A};

int big_endian_16(std::span<const std::uint8_t> bytes, std::size_t at) { return bytes[at] << 8 | bytes[at + 1]; }

bool is_png(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 24 && std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin());
}

Result<ImageSize> png_size(std::span<const std::uint8_t> bytes) {
  // The high halves of both 32-bit sizes must be zero: nothing larger than 65535 pixels is an image of ours.
  if (big_endian_16(bytes, 16) != 0 || big_endian_16(bytes, 20) != 0) return fail("image of an implausible size");
  return ImageSize{big_endian_16(bytes, 18), big_endian_16(bytes, 22)};
}

/// Whether a marker begins the frame header of a JPEG: C0 to CF without C4 (tables), C8 (reserved) and CC (arithmetic
/// coding).
bool starts_jpeg_frame(int marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

Result<ImageSize> jpeg_size(std::span<const std::uint8_t> bytes) {
  std::size_t at = 2;
  while (at + 9 <= bytes.size() && bytes[at] == 0xFF) {
    const int marker = bytes[at + 1];
    if (marker == 0xFF) {  // a fill byte before a marker
      ++at;
    } else if (starts_jpeg_frame(marker)) {
      return ImageSize{big_endian_16(bytes, at + 7), big_endian_16(bytes, at + 5)};
    } else {
      at += 2 + static_cast<std::size_t>(big_endian_16(bytes, at + 2));
    }
  }
  return fail("JPEG without a frame header");
}

/// Whether the JPEG has its end marker. If its compressed rows are cut short, libjpeg fills the rest with grey and only
/// warns. Cameras may pad after the marker.
bool has_jpeg_end(std::span<const std::uint8_t> bytes) {
  for (std::size_t i = bytes.size() - 1; i > 0 && bytes.size() - i < 1024; --i) {
    if (bytes[i - 1] == 0xFF && bytes[i] == 0xD9) return true;
  }
  return false;
}

}  // namespace

Result<ImageSize> compressed_image_size(std::span<const std::uint8_t> bytes) {
  const bool jpeg = bytes.size() >= 4 && bytes[0] == 0xFF && bytes[1] == 0xD8;
  if (!jpeg && !is_png(bytes)) return fail("neither a PNG nor a JPEG image");
  const Result<ImageSize> size = jpeg ? jpeg_size(bytes) : png_size(bytes);
  if (size && !possible_size(size->width, size->height)) return fail("image of an implausible size");
  return size;
}

Result<Image<Rgb>> decode_image(std::span<const std::uint8_t> bytes, ImageSize expected) {
  const Result<ImageSize> size = compressed_image_size(bytes);
  if (!size) return tl::unexpected(size.error());
  if (*size != expected) {
    return fail("colour image is " + std::to_string(size->width) + "x" + std::to_string(size->height) + ", expected " +
                std::to_string(expected.width) + "x" + std::to_string(expected.height));
  }
  if (is_png(bytes)) return decode_png_colour(bytes, expected.width, expected.height);
  if (!has_jpeg_end(bytes)) return fail("JPEG ends too early");
  return decode_jpeg(bytes, expected.width, expected.height);
}

Result<Image<std::uint16_t>> decode_depth_image(std::span<const std::uint8_t> bytes) {
  const Result<ImageSize> size = compressed_image_size(bytes);
  if (!size) return tl::unexpected(size.error());
  if (!is_png(bytes)) return fail("is not a 16-bit image with one channel", {}, "store depth in this format");
  return decode_png_depth(bytes, size->width, size->height);
}

}  // namespace barehand
