// Reads and writes the depth and colour images of a recording.
#include "io/recording/image_file.h"

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "io/file_bytes.h"
#include "io/recording/image_codec.h"
#include "io/recording/jpeg_codec.h"
#include "io/recording/png_codec.h"

namespace barehand {
namespace {

using Bytes = std::vector<unsigned char>;

std::span<const unsigned char> bytes_of(const std::string& file) {
  return {reinterpret_cast<const unsigned char*>(file.data()), file.size()};
}

Result<void> write_bytes(const std::string& path, const Bytes& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) return fail("cannot be written", path, "check the folder, its permissions and the free space");
  return {};
}

/// Adds the path to the error of a codec, which does not know the file.
template <typename T>
Result<T> located(Result<T> result, const std::string& path) {
  if (!result) result.error().where = path;
  return result;
}

}  // namespace

Result<Image<std::uint16_t>> read_depth_png(const std::string& path) {
  const auto file = read_file(path);
  if (!file) return tl::unexpected(file.error());
  return located(decode_depth_image(bytes_of(*file)), path);
}

Result<Image<Rgb>> read_colour(const std::string& path) {
  const auto file = read_file(path);
  if (!file) return tl::unexpected(file.error());
  const auto bytes = bytes_of(*file);
  return located(compressed_image_size(bytes).and_then([&](ImageSize size) { return decode_image(bytes, size); }),
                 path);
}

Result<void> check_size(int width, int height, const Intrinsics& camera, const std::string& path) {
  if (width == camera.width && height == camera.height) return {};
  const auto text = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
  return fail("is " + text(width, height) + ", camera.json says " + text(camera.width, camera.height), path,
              "intrinsics hold for one size only: correct camera.json or the images");
}

Result<void> write_depth_png(const std::string& path, const Image<std::uint16_t>& depth) {
  const auto bytes = located(encode_png(depth), path);
  if (!bytes) return tl::unexpected(bytes.error());
  return write_bytes(path, *bytes);
}

Result<void> write_colour(const std::string& path, const Image<Rgb>& colour) {
  constexpr int kQuality = 95;
  const bool png = std::filesystem::path(path).extension() == ".png";
  const auto bytes = located(png ? encode_png(colour) : encode_jpeg(colour, kQuality), path);
  if (!bytes) return tl::unexpected(bytes.error());
  return write_bytes(path, *bytes);
}

}  // namespace barehand
