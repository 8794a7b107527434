#include "io/image_file.h"

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/file_bytes.h"
#include "io/image_codec.h"

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

/// The error of a codec, which does not know the file.
template <typename T>
Result<T> located(Result<T> result, const std::string& path) {
  if (!result) result.error().where = path;
  return result;
}

}  // namespace

Result<Image<std::uint16_t>> read_depth_png(const std::string& path) {
  const auto file = read_file(path);
  if (!file) return tl::unexpected(file.error());
  const auto bytes = bytes_of(*file);
  // Before OpenCV, which allocates whatever a header claims and knows a dozen other formats.
  if (const auto size = located(compressed_image_size(bytes), path); !size) return tl::unexpected(size.error());
  try {
    const cv::Mat image =
        cv::imdecode(cv::_InputArray(bytes.data(), static_cast<int>(bytes.size())), cv::IMREAD_UNCHANGED);
    if (image.empty()) return fail("is damaged or no image", path);
    if (image.type() != CV_16UC1) return fail("is no 16-bit image of one channel", path, "depth is stored that way");
    Image<std::uint16_t> depth(image.cols, image.rows);
    image.copyTo(cv::Mat(image.rows, image.cols, CV_16UC1, depth.data()));
    return depth;
  } catch (const cv::Exception& error) {
    return fail("is damaged: " + error.err, path);
  }
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
  const cv::Mat image(depth.height(), depth.width(), CV_16UC1, const_cast<std::uint16_t*>(depth.data()));
  Bytes bytes;
  try {
    if (!cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 3})) return fail("cannot be encoded", path);
  } catch (const cv::Exception& error) {
    return fail("cannot be encoded: " + error.err, path);
  }
  return write_bytes(path, bytes);
}

Result<void> write_colour(const std::string& path, const Image<Rgb>& colour) {
  constexpr int kQuality = 95;
  const bool png = std::filesystem::path(path).extension() == ".png";
  const auto bytes = located(png ? encode_png(colour) : encode_jpeg(colour, kQuality), path);
  if (!bytes) return tl::unexpected(bytes.error());
  return write_bytes(path, *bytes);
}

}  // namespace barehand
