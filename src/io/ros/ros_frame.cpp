// Converts frames to ROS image messages and back.
#include "io/ros/ros_frame.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "io/recording/jpeg_codec.h"
#include "io/recording/png_codec.h"
#include "io/ros/ros_time.h"
#include "sensor/camera_limits.h"

namespace barehand::ros {
namespace {

static_assert(std::endian::native == std::endian::little, "pixels and points are copied as they lie in memory");

Header header_of(const RgbdFrame& frame) { return {time_of(frame.utime).value_or(Time{}), camera_frame(frame.sensor)}; }

/// Error unless `image` holds rows of `pixel` bytes each.
Result<void> check_rows(const Image& image, std::size_t pixel) {
  if (!possible_size(image.width, image.height))
    return fail("has the impossible size " + std::to_string(image.width) + "x" + std::to_string(image.height));
  if (image.step < pixel * image.width || image.data.size() < std::size_t{image.step} * image.height)
    return fail("has fewer pixels than its size says");
  return {};
}

float packed_colour(const Rgb& colour) {
  const std::uint32_t bits = std::uint32_t{colour.r} << 16 | std::uint32_t{colour.g} << 8 | colour.b;
  return std::bit_cast<float>(bits);
}

}  // namespace

std::string camera_frame(const std::string& sensor) { return (sensor.empty() ? "camera" : sensor) + "_optical_frame"; }

CameraInfo camera_info(const RgbdFrame& frame) {
  const Intrinsics& camera = frame.camera;
  CameraInfo info;
  info.header = header_of(frame);
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.d.assign(5, 0.0);
  info.k = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.p = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

Image depth_image(const RgbdFrame& frame) {
  Image image;
  image.header = header_of(frame);
  image.width = static_cast<std::uint32_t>(frame.depth.width());
  image.height = static_cast<std::uint32_t>(frame.depth.height());
  image.encoding = "16UC1";
  image.step = 2 * image.width;
  image.data.resize(std::size_t{image.step} * image.height);
  std::memcpy(image.data.data(), frame.depth.data(), image.data.size());
  return image;
}

Result<CompressedImage> colour_image(const RgbdFrame& frame, std::optional<int> jpeg_quality) {
  auto bytes = jpeg_quality ? encode_jpeg(frame.colour, *jpeg_quality) : encode_png(frame.colour);
  if (!bytes) return tl::unexpected(bytes.error());
  return CompressedImage{header_of(frame), jpeg_quality ? "jpeg" : "png", std::move(*bytes)};
}

PointCloud2 point_cloud(const RgbdFrame& frame, int most) {
  const bool coloured = !frame.colour.empty();
  PointCloud2 cloud;
  cloud.header = header_of(frame);

  // Describe the fields of a point: its position, and its colour if the frame has some.
  for (const char* name : {"x", "y", "z", "rgb"})
    if (coloured || std::strcmp(name, "rgb") != 0)
      cloud.point_fields.push_back({name, 4 * static_cast<std::uint32_t>(cloud.point_fields.size())});
  cloud.point_step = 4 * static_cast<std::uint32_t>(cloud.point_fields.size());

  // Take the middle pixel of each cell of the grid if it has depth.
  const int step = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(frame.depth.size()) / most))));
  for (int v = step / 2; v < frame.depth.height(); v += step)
    for (int u = step / 2; u < frame.depth.width(); u += step) {
      // Compute the point, and append its fields as bytes.
      const std::uint16_t count = frame.depth.at(u, v);
      if (count == 0) continue;
      const Eigen::Vector3f p = frame.camera.unproject(u, v, count * frame.depth_unit).cast<float>();
      const float values[] = {p.x(), p.y(), p.z(), coloured ? packed_colour(frame.colour.at(u, v)) : 0.0F};
      const auto* first = reinterpret_cast<const std::uint8_t*>(values);
      cloud.data.insert(cloud.data.end(), first, first + cloud.point_step);
    }

  // Set the size of the cloud, which is a single row of points.
  cloud.width = static_cast<std::uint32_t>(cloud.data.size()) / cloud.point_step;
  cloud.row_step = static_cast<std::uint32_t>(cloud.data.size());
  return cloud;
}

Result<barehand::Image<std::uint16_t>> depth_of(const Image& image) {
  if (image.encoding != "16UC1" && image.encoding != "mono16")
    return fail("depth in the encoding " + image.encoding + " is not read", "", "record 16UC1, counts of 16 bits");
  if (auto good = check_rows(image, 2); !good) return tl::unexpected(good.error());
  barehand::Image<std::uint16_t> depth(static_cast<int>(image.width), static_cast<int>(image.height));
  for (int v = 0; v < depth.height(); ++v)
    std::memcpy(depth.row(v), image.data.data() + std::size_t{image.step} * static_cast<std::size_t>(v),
                2 * std::size_t{image.width});
  if (image.is_bigendian != 0)
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = static_cast<std::uint16_t>(depth[i] << 8 | depth[i] >> 8);
  return depth;
}

Result<barehand::Image<Rgb>> colour_of(const Image& image) {
  const bool bgr = image.encoding == "bgr8";
  if (!bgr && image.encoding != "rgb8")
    return fail("colour in the encoding " + image.encoding + " is not read", "", "record rgb8, bgr8, PNG or JPEG");
  if (auto good = check_rows(image, 3); !good) return tl::unexpected(good.error());
  barehand::Image<Rgb> colour(static_cast<int>(image.width), static_cast<int>(image.height));
  for (int v = 0; v < colour.height(); ++v) {
    const std::uint8_t* from = image.data.data() + std::size_t{image.step} * static_cast<std::size_t>(v);
    for (int u = 0; u < colour.width(); ++u, from += 3)
      colour.at(u, v) = bgr ? Rgb{from[2], from[1], from[0]} : Rgb{from[0], from[1], from[2]};
  }
  return colour;
}

Result<Intrinsics> camera_of(const CameraInfo& info) {
  if (!possible_size(info.width, info.height)) return fail("camera info without a possible image size");
  const Intrinsics camera{
      static_cast<int>(info.width), static_cast<int>(info.height), info.k[0], info.k[4], info.k[2], info.k[5]};
  if (!plausible(camera)) return fail("camera info without valid intrinsics");
  return camera;
}

}  // namespace barehand::ros
