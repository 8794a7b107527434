#include "io/image_file.h"

#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace barehand {
namespace {

using Bytes = std::vector<unsigned char>;

Result<Bytes> read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail("cannot be read", path);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

/// libjpeg fills what is missing with grey and only warns; the end-of-image marker tells.
bool truncated_jpeg(const Bytes& bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return false;
  for (std::size_t i = bytes.size() - 1; i > 0 && bytes.size() - i < 1024; --i)
    if (bytes[i - 1] == 0xFF && bytes[i] == 0xD9) return false;
  return true;
}

Result<cv::Mat> decode(const std::string& path, int flags) {
  const auto bytes = read_bytes(path);
  if (!bytes) return tl::unexpected(bytes.error());
  cv::Mat image;
  try {
    if (!bytes->empty() && !truncated_jpeg(*bytes)) image = cv::imdecode(*bytes, flags);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) return fail("is damaged or no image", path);
  return image;
}

Result<void> encode(const std::string& path, const cv::Mat& image, const std::vector<int>& options) {
  Bytes bytes;
  try {
    const std::string ending = path.substr(path.find_last_of('.'));
    if (!cv::imencode(ending, image, bytes, options)) return fail("cannot be encoded", path);
  } catch (const cv::Exception& error) {
    return fail("cannot be encoded: " + error.err, path);
  }
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) return fail("cannot be written", path, "check the folder, its permissions and the free space");
  return {};
}

}  // namespace

Result<Image<std::uint16_t>> read_depth_png(const std::string& path) {
  const auto image = decode(path, cv::IMREAD_UNCHANGED);
  if (!image) return tl::unexpected(image.error());
  if (image->type() != CV_16UC1) return fail("is no 16-bit image of one channel", path, "depth is stored that way");
  Image<std::uint16_t> depth(image->cols, image->rows);
  image->copyTo(cv::Mat(image->rows, image->cols, CV_16UC1, depth.data()));
  return depth;
}

Result<Image<Rgb>> read_colour(const std::string& path) {
  const auto image = decode(path, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (!image) return tl::unexpected(image.error());
  Image<Rgb> colour(image->cols, image->rows);
  cv::cvtColor(*image, cv::Mat(image->rows, image->cols, CV_8UC3, colour.data()), cv::COLOR_BGR2RGB);
  return colour;
}

Result<void> check_size(int width, int height, const Intrinsics& camera, const std::string& path) {
  if (width == camera.width && height == camera.height) return {};
  const auto text = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
  return fail("is " + text(width, height) + ", camera.json says " + text(camera.width, camera.height), path,
              "intrinsics hold for one size only: correct camera.json or the images");
}

Result<void> write_depth_png(const std::string& path, const Image<std::uint16_t>& depth) {
  const cv::Mat image(depth.height(), depth.width(), CV_16UC1, const_cast<std::uint16_t*>(depth.data()));
  return encode(path, image, {cv::IMWRITE_PNG_COMPRESSION, 3});
}

Result<void> write_colour(const std::string& path, const Image<Rgb>& colour) {
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(colour.height(), colour.width(), CV_8UC3, const_cast<Rgb*>(colour.data())), bgr,
               cv::COLOR_RGB2BGR);
  return encode(path, bgr, {cv::IMWRITE_JPEG_QUALITY, 95, cv::IMWRITE_PNG_COMPRESSION, 3});
}

}  // namespace barehand
