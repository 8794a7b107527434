// Converts frames to rgbd_frame_t messages and back.
#include "drivers/lcm/frame_codec.h"

#include <cstring>
#include <string>

#include "io/recording/image_codec.h"
#include "io/recording/jpeg_codec.h"
#include "io/recording/png_codec.h"
#include "sensor/camera_limits.h"

namespace barehand {
namespace {

using Bytes = std::vector<std::uint8_t>;

Result<void> check_sizes(const RgbdFrame& frame) {
  const Intrinsics& camera = frame.camera;
  const auto fits = [&](const auto& image) { return image.width() == camera.width && image.height() == camera.height; };
  if (!fits(frame.depth)) return fail("depth image and intrinsics differ in size");
  if (!frame.colour.empty() && !fits(frame.colour)) return fail("colour image and intrinsics differ in size");
  return check_image_size(camera.width, camera.height);
}

Result<Bytes> encode_colour(const Image<Rgb>& colour, const FrameEncoding& encoding) {
  switch (encoding.colour) {
    case ColourEncoding::none:
      return Bytes{};

    // Raw colour is copied as it lies in memory.
    case ColourEncoding::raw_rgb: {
      static_assert(sizeof(Rgb) == 3, "pixels are copied as they lie in memory");
      const auto* first = reinterpret_cast<const std::uint8_t*>(colour.data());
      return Bytes(first, first + sizeof(Rgb) * colour.size());
    }

    // The other encodings compress the image.
    case ColourEncoding::jpeg:
      return encode_jpeg(colour, encoding.jpeg_quality);
    case ColourEncoding::png:
      return encode_png(colour);
  }
  return fail("unknown colour encoding");
}

Result<Image<Rgb>> decode_colour(const rgbd_frame_t& message) {
  switch (static_cast<ColourEncoding>(message.colour_encoding)) {
    case ColourEncoding::none:
      if (!message.colour.empty()) return fail("colour data in a frame that says it has none");
      return Image<Rgb>();

    // Raw colour must have the size of the image.
    case ColourEncoding::raw_rgb: {
      Image<Rgb> colour(message.width, message.height);
      if (message.colour.size() != sizeof(Rgb) * colour.size()) return fail("raw colour of the wrong size");
      std::memcpy(static_cast<void*>(colour.data()), message.colour.data(), message.colour.size());
      return colour;
    }

    // Compressed images name their own format, so one decoder serves both.
    case ColourEncoding::jpeg:
    case ColourEncoding::png:
      return decode_image(message.colour, {message.width, message.height});
  }
  return fail("unknown colour encoding " + std::to_string(message.colour_encoding));
}

Result<void> check_numbers(const rgbd_frame_t& message) {
  if (auto size = check_image_size(message.width, message.height); !size) return size;
  const Intrinsics camera{message.width, message.height, message.fx, message.fy, message.cx, message.cy};
  if (!plausible(camera)) return fail("frame without valid intrinsics");
  if (!(message.depth_unit >= 1e-7 && message.depth_unit <= 1)) return fail("frame without a valid depth unit");
  return {};
}

}  // namespace

Result<rgbd_frame_t> encode_frame(const RgbdFrame& frame, const FrameEncoding& encoding) {
  if (auto sizes = check_sizes(frame); !sizes) return tl::unexpected(sizes.error());

  // Copy the time stamp, the frame number and the name of the sensor.
  rgbd_frame_t message;
  message.utime = frame.utime;
  message.seq = frame.number;
  message.sensor = frame.sensor;

  // Copy the intrinsics of the camera.
  message.width = frame.camera.width;
  message.height = frame.camera.height;
  message.fx = frame.camera.fx;
  message.fy = frame.camera.fy;
  message.cx = frame.camera.cx;
  message.cy = frame.camera.cy;

  // Encode the depth.
  message.depth_unit = frame.depth_unit;
  message.depth_encoding = static_cast<std::int8_t>(encoding.depth);
  message.depth = encode_depth(frame.depth, encoding.depth);
  message.depth_size = static_cast<std::int32_t>(message.depth.size());

  // Encode the colour, if there is any and it is wanted.
  const bool has_colour = !frame.colour.empty() && encoding.colour != ColourEncoding::none;
  message.colour_encoding = static_cast<std::int8_t>(has_colour ? encoding.colour : ColourEncoding::none);
  if (has_colour) {
    Result<Bytes> colour = encode_colour(frame.colour, encoding);
    if (!colour) return tl::unexpected(colour.error());
    message.colour = std::move(*colour);
  }
  message.colour_size = static_cast<std::int32_t>(message.colour.size());
  return message;
}

Result<std::shared_ptr<RgbdFrame>> decode_frame(const rgbd_frame_t& message) {
  // Check the header, and decode the depth.
  if (auto numbers = check_numbers(message); !numbers) return tl::unexpected(numbers.error());
  auto depth =
      decode_depth(message.depth, static_cast<DepthEncoding>(message.depth_encoding), message.width, message.height);
  if (!depth) return tl::unexpected(depth.error());

  // Copy the header into the frame.
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = message.utime;
  frame->number = message.seq;
  frame->sensor = message.sensor;
  frame->camera = {message.width, message.height, message.fx, message.fy, message.cx, message.cy};
  frame->depth_unit = message.depth_unit;
  frame->depth = std::move(*depth);

  // If the colour cannot be read, the frame is delivered without it.
  if (auto colour = decode_colour(message))
    frame->colour = std::move(*colour);
  else
    frame->colour_fault = colour.error().message();
  return frame;
}

}  // namespace barehand
