// Decodes and encodes JPEG images with libjpeg.
#include "io/recording/jpeg_codec.h"

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <new>
#include <string>

// Must follow <cstdio>, since it uses FILE.
#include <jerror.h>
#include <jpeglib.h>

namespace barehand {
namespace {

constexpr int kCmykChannels = 4;
/// Largest number of scans in a progressive JPEG; encoders write about ten. Decoding each one takes as much time as the
/// whole image.
constexpr int kMaxScans = 100;

/// Error handlers for libjpeg that keep the error, since its default handlers would print it and end the program.
struct ErrorManager {
  jpeg_error_mgr base;  // must be the first member, because libjpeg passes its address to the handlers
  std::jmp_buf leave;
  std::array<char, JMSG_LENGTH_MAX> message;
};

[[noreturn]] void on_error(j_common_ptr codec) {
  auto* errors = reinterpret_cast<ErrorManager*>(codec->err);
  errors->base.format_message(codec, errors->message.data());
  std::longjmp(errors->leave, 1);
}

jpeg_error_mgr* quiet_errors(ErrorManager& errors) {
  jpeg_std_error(&errors.base);
  errors.base.error_exit = on_error;
  errors.base.output_message = [](j_common_ptr) {};
  return &errors.base;
}

/// Runs `step`; returns false if libjpeg reported an error meanwhile. An error leaves `step` by longjmp, which runs no
/// destructors, so `step` and the callbacks below must not hold objects with destructors.
template <typename Step>
bool guarded(ErrorManager& errors, Step&& step) {
  if (setjmp(errors.leave) != 0) return false;
  step();
  return true;
}

/// A source of libjpeg that reads from memory and reports an early end as an error; libjpeg's own source would insert
/// an end marker and fill the rest of the image with grey.
jpeg_source_mgr memory_source(std::span<const std::uint8_t> bytes) {
  jpeg_source_mgr source{};

  // Give all bytes at once, so a request for more means that the file ends early.
  source.next_input_byte = bytes.data();
  source.bytes_in_buffer = bytes.size();
  source.init_source = [](j_decompress_ptr) {};
  source.fill_input_buffer = [](j_decompress_ptr codec) -> boolean {
    codec->err->msg_code = JERR_INPUT_EOF;
    codec->err->error_exit(reinterpret_cast<j_common_ptr>(codec));
    return FALSE;
  };

  // Skip data that is not needed, but not beyond the end.
  source.skip_input_data = [](j_decompress_ptr codec, long count) {
    if (count <= 0) return;
    if (static_cast<std::size_t>(count) > codec->src->bytes_in_buffer) codec->src->fill_input_buffer(codec);
    codec->src->next_input_byte += count;
    codec->src->bytes_in_buffer -= static_cast<std::size_t>(count);
  };

  // Use the default of libjpeg for restart markers; at the end, there is nothing to do.
  source.resync_to_restart = jpeg_resync_to_restart;
  source.term_source = [](j_decompress_ptr) {};
  return source;
}

void limit_scans(j_common_ptr codec) {
  if (reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number <= kMaxScans) return;
  codec->err->msg_code = JERR_BAD_PROGRESSION;
  codec->err->error_exit(codec);
}

/// Reads one JPEG from memory.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : source_(memory_source(bytes)) {
    codec_.err = quiet_errors(errors_);
    progress_.progress_monitor = limit_scans;
  }
  ~Reader() { jpeg_destroy_decompress(&codec_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  Result<void> open(int width, int height) {
    const auto read_header = [this] {
      jpeg_create_decompress(&codec_);
      codec_.src = &source_;
      codec_.progress = &progress_;
      jpeg_read_header(&codec_, TRUE);
    };
    if (!guarded(errors_, read_header)) return damaged();
    if (codec_.image_width != static_cast<JDIMENSION>(width) || codec_.image_height != static_cast<JDIMENSION>(height))
      return fail("damaged JPEG image: its size differs from the one in its header");
    return {};
  }

  Result<void> read(Image<Rgb>& image) {
    const auto read_rows = [&] {
      // Let libjpeg convert all colours but those of print, which it leaves in CMYK.
      const bool cmyk = codec_.num_components == kCmykChannels;
      codec_.out_color_space = cmyk ? JCS_CMYK : JCS_RGB;
      jpeg_start_decompress(&codec_);
      const JSAMPARRAY inks = cmyk ? codec_.mem->alloc_sarray(reinterpret_cast<j_common_ptr>(&codec_), JPOOL_IMAGE,
                                                              codec_.output_width * kCmykChannels, 1)
                                   : nullptr;

      // Read the image row by row.
      for (int v = 0; v < image.height(); ++v) {
        auto* row = reinterpret_cast<JSAMPROW>(image.row(v));
        jpeg_read_scanlines(&codec_, cmyk ? inks : &row, 1);
        if (cmyk) to_rgb(inks[0], image.width(), image.row(v));
      }
    };
    // Read the rows; data after the last one is ignored.
    return guarded(errors_, read_rows) ? Result<void>() : damaged();
  }

 private:
  /// Converts CMYK, which Adobe stores inverted (255 is no ink), so that a colour is the product of its stored ink and
  /// the stored black.
  static void to_rgb(const JSAMPLE* inks, int width, Rgb* row) {
    for (int u = 0; u < width; ++u, inks += kCmykChannels) {
      const int black = inks[3];
      const auto channel = [&](int ink) { return static_cast<std::uint8_t>(black - ((255 - ink) * black >> 8)); };
      row[u] = {channel(inks[0]), channel(inks[1]), channel(inks[2])};
    }
  }
  tl::unexpected<Error> damaged() const { return fail(std::string("damaged JPEG image: ") + errors_.message.data()); }

  jpeg_source_mgr source_;
  jpeg_progress_mgr progress_{};
  ErrorManager errors_{};
  jpeg_decompress_struct codec_{};
};

/// Writes one JPEG into memory.
class Writer {
 public:
  Writer() {
    codec_.err = quiet_errors(errors_);
    codec_.client_data = this;
    destination_.init_destination = grow;
    destination_.empty_output_buffer = [](j_compress_ptr codec) -> boolean { return grow(codec), TRUE; };
    destination_.term_destination = [](j_compress_ptr) {};
  }
  ~Writer() { jpeg_destroy_compress(&codec_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  Result<std::vector<std::uint8_t>> write(const Image<Rgb>& image, int quality) {
    const auto write_all = [&] {
      // Describe the image, and choose the quality.
      jpeg_create_compress(&codec_);
      codec_.dest = &destination_;
      codec_.image_width = static_cast<JDIMENSION>(image.width());
      codec_.image_height = static_cast<JDIMENSION>(image.height());
      codec_.input_components = 3;
      codec_.in_color_space = JCS_RGB;
      jpeg_set_defaults(&codec_);
      jpeg_set_quality(&codec_, quality, TRUE);

      // Compress the image row by row.
      jpeg_start_compress(&codec_, TRUE);
      for (int v = 0; v < image.height(); ++v) {
        auto* row = reinterpret_cast<JSAMPROW>(const_cast<Rgb*>(image.row(v)));
        jpeg_write_scanlines(&codec_, &row, 1);
      }
      jpeg_finish_compress(&codec_);
    };

    // Encode with the errors of libjpeg caught, then shorten the buffer to the bytes that were written.
    if (!guarded(errors_, write_all))
      return fail(std::string("cannot be encoded as a JPEG: ") + errors_.message.data());
    bytes_.resize(bytes_.size() - destination_.free_in_buffer);
    return std::move(bytes_);
  }

 private:
  /// Called when the output buffer is full, and at the start.
  static void grow(j_compress_ptr codec) {
    auto& bytes = static_cast<Writer*>(codec->client_data)->bytes_;
    const std::size_t used = bytes.size();

    // Enlarge the buffer, and note if there is not enough memory.
    bool grown = true;
    try {
      bytes.resize(2 * used + 65536);
    } catch (const std::bad_alloc&) {  // exceptions must not pass through libjpeg, nor longjmp leave this handler
      grown = false;
    }

    // Report the lack of memory in the way of libjpeg.
    if (!grown) {
      codec->err->msg_code = JERR_OUT_OF_MEMORY;
      codec->err->msg_parm.i[0] = 0;
      codec->err->error_exit(reinterpret_cast<j_common_ptr>(codec));
    }

    // Let libjpeg continue behind the bytes that are in use.
    codec->dest->next_output_byte = bytes.data() + used;
    codec->dest->free_in_buffer = bytes.size() - used;
  }

  std::vector<std::uint8_t> bytes_;
  jpeg_destination_mgr destination_{};
  ErrorManager errors_{};
  jpeg_compress_struct codec_{};
};

}  // namespace

Result<Image<Rgb>> decode_jpeg(std::span<const std::uint8_t> bytes, int width, int height) {
  Reader reader(bytes);
  if (const auto opened = reader.open(width, height); !opened) return tl::unexpected(opened.error());
  Image<Rgb> image(width, height);
  if (const auto read = reader.read(image); !read) return tl::unexpected(read.error());
  return image;
}

Result<std::vector<std::uint8_t>> encode_jpeg(const Image<Rgb>& image, int quality) {
  if (image.empty()) return fail("an empty image cannot be encoded");
  return Writer().write(image, quality);
}

}  // namespace barehand
