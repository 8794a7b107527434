// Encodes and decodes PNG images with libpng.
#include "io/recording/png_codec.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>

namespace barehand {
namespace {

constexpr int kColourLevel = 1, kDepthLevel = 3;  // compression levels of zlib, from 1 (fast) to 9 (small)

using Message = std::array<char, 128>;

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto& kept = *static_cast<Message*>(png_get_error_ptr(png));
  std::snprintf(kept.data(), kept.size(), "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}  // ignores warnings, which concern nothing that changes the pixels

/// Runs `step`; returns false if libpng reported an error meanwhile. An error leaves `step` by longjmp, which runs no
/// destructors, so `step` and the callbacks below must not hold objects with destructors when they call libpng.
template <typename Step>
bool guarded(png_structp png, Step&& step) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  step();
  return true;
}

/// Reads one PNG from memory.
class PngReader {
 public:
  explicit PngReader(std::span<const std::uint8_t> bytes)
      : rest_(bytes), png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, on_error, on_warning)) {
    if (png_) info_ = png_create_info_struct(png_);
    if (info_) png_set_read_fn(png_, this, give);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// Reads the image's headers. Errors: damage, or a size other than `width` by `height`.
  Result<void> open(int width, int height) {
    if (!info_) return fail("libpng cannot be started");
    if (!guarded(png_, [this] { png_read_info(png_, info_); })) return damaged();
    if (png_get_image_width(png_, info_) != static_cast<png_uint_32>(width) ||
        png_get_image_height(png_, info_) != static_cast<png_uint_32>(height))
      return fail("damaged PNG image: its size differs from the one in its header");
    return {};
  }
  int colour_type() const { return png_get_color_type(png_, info_); }
  int bit_depth() const { return png_get_bit_depth(png_, info_); }

  Result<void> read_as_rgb(Image<Rgb>& image) {
    const auto read = [&] {
      png_set_strip_16(png_);
      png_set_strip_alpha(png_);
      if (colour_type() == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
      if ((colour_type() & PNG_COLOR_MASK_COLOR) == 0) {
        if (bit_depth() < 8) png_set_expand_gray_1_2_4_to_8(png_);
        png_set_gray_to_rgb(png_);
      }
      read_rows(image);
    };
    return guarded(png_, read) ? Result<void>() : damaged();
  }
  Result<void> read_as_stored(Image<std::uint16_t>& image) {
    const auto read = [&] {
      if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
      read_rows(image);
    };
    return guarded(png_, read) ? Result<void>() : damaged();
  }

 private:
  tl::unexpected<Error> damaged() const { return fail(std::string("damaged PNG image: ") + message_.data()); }
  static void give(png_structp png, png_bytep to, std::size_t size) {
    auto& rest = static_cast<PngReader*>(png_get_io_ptr(png))->rest_;
    if (size > rest.size()) png_error(png, "it ends too early");
    std::memcpy(to, rest.data(), size);
    rest = rest.subspan(size);
  }
  template <typename Pixel>
  void read_rows(Image<Pixel>& image) {
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != static_cast<std::size_t>(image.width()) * sizeof(Pixel))
      png_error(png_, "it has rows of an unexpected length");
    for (int pass = 0; pass < passes; ++pass)
      for (int v = 0; v < image.height(); ++v) png_read_row(png_, reinterpret_cast<png_bytep>(image.row(v)), nullptr);
    png_read_end(png_, nullptr);
  }

  std::span<const std::uint8_t> rest_;
  Message message_{};
  png_structp png_;
  png_infop info_ = nullptr;
};

/// Writes one PNG into memory.
class PngWriter {
 public:
  PngWriter() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &message_, on_error, on_warning)) {
    if (png_) info_ = png_create_info_struct(png_);
    if (info_) png_set_write_fn(png_, this, take, [](png_structp) {});
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  template <typename Pixel>
  Result<std::vector<std::uint8_t>> write(const Image<Pixel>& image, int level, int bits, int colour_type) {
    if (image.empty()) return fail("an empty image cannot be encoded");
    if (!info_) return fail("libpng cannot be started");
    const auto write_all = [&] {
      // Write the header of the image.
      png_set_compression_level(png_, level);
      png_set_compression_strategy(png_, 0);  // the default strategy of zlib
      png_set_IHDR(png_, info_, static_cast<png_uint_32>(image.width()), static_cast<png_uint_32>(image.height()), bits,
                   colour_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
      png_write_info(png_, info_);

      // Write the rows; PNG stores numbers in big-endian order.
      if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
      for (int v = 0; v < image.height(); ++v) png_write_row(png_, reinterpret_cast<png_const_bytep>(image.row(v)));
      png_write_end(png_, info_);
    };

    // Report the message of libpng if it fails.
    if (!guarded(png_, write_all)) return fail(std::string("cannot be encoded as a PNG: ") + message_.data());
    return std::move(bytes_);
  }

 private:
  static void take(png_structp png, png_bytep from, std::size_t size) {
    bool taken = true;
    try {
      auto& bytes = static_cast<PngWriter*>(png_get_io_ptr(png))->bytes_;
      bytes.insert(bytes.end(), from, from + size);
    } catch (const std::bad_alloc&) {  // exceptions must not pass through libpng, nor longjmp leave this handler
      taken = false;
    }
    if (!taken) png_error(png, "out of memory");
  }

  std::vector<std::uint8_t> bytes_;
  Message message_{};
  png_structp png_;
  png_infop info_ = nullptr;
};

}  // namespace

Result<Image<Rgb>> decode_png_colour(std::span<const std::uint8_t> bytes, int width, int height) {
  PngReader reader(bytes);
  if (const auto opened = reader.open(width, height); !opened) return tl::unexpected(opened.error());
  Image<Rgb> image(width, height);
  if (const auto read = reader.read_as_rgb(image); !read) return tl::unexpected(read.error());
  return image;
}

Result<Image<std::uint16_t>> decode_png_depth(std::span<const std::uint8_t> bytes, int width, int height) {
  PngReader reader(bytes);
  if (const auto opened = reader.open(width, height); !opened) return tl::unexpected(opened.error());
  if (reader.colour_type() != PNG_COLOR_TYPE_GRAY || reader.bit_depth() != 16)
    return fail("is not a 16-bit image with one channel", {}, "store depth in this format");
  Image<std::uint16_t> image(width, height);
  if (const auto read = reader.read_as_stored(image); !read) return tl::unexpected(read.error());
  return image;
}

Result<std::vector<std::uint8_t>> encode_png(const Image<Rgb>& image) {
  return PngWriter().write(image, kColourLevel, 8, PNG_COLOR_TYPE_RGB);
}

Result<std::vector<std::uint8_t>> encode_png(const Image<std::uint16_t>& image) {
  return PngWriter().write(image, kDepthLevel, 16, PNG_COLOR_TYPE_GRAY);
}

}  // namespace barehand
