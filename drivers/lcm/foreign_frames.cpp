// Decodes the frame messages of other projects (kinect.frame_msg_t and bot_core.images_t).
#include "drivers/lcm/foreign_frames.h"

#include <algorithm>
#include <string>

#include "core/format.h"
#include "drivers/lcm/depth_codec.h"
#include "drivers/lcm/wire.h"
#include "io/recording/image_codec.h"

namespace barehand {
namespace {

Result<std::shared_ptr<RgbdFrame>> make_frame(std::int64_t utime, std::int64_t number, const GivenIntrinsics& camera,
                                              Result<Image<std::uint16_t>> depth, Result<Image<Rgb>> colour) {
  // Refuse frames without usable intrinsics or depth.
  if (!camera.any()) {
    return fail("this message type carries no intrinsics", "",
                "set fx, fy, cx and cy of the depth camera in the configuration");
  }
  if (auto possible = check(camera); !possible) return tl::unexpected(possible.error());
  if (!depth) return tl::unexpected(depth.error());

  // Fill the frame; these message types give depth in millimetres.
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = utime;
  frame->number = number;
  frame->camera = camera.of_size(depth->width(), depth->height());
  frame->depth_unit = 0.001;
  frame->depth = std::move(*depth);

  // If the colour cannot be read, the frame is delivered without it.
  if (colour)
    frame->colour = std::move(*colour);
  else
    frame->colour_fault = colour.error().message();
  return frame;
}

tl::unexpected<Error> other_size(ImageSize colour, ImageSize depth) {
  return fail(formatted("is %dx%d, depth is %dx%d", colour.width, colour.height, depth.width, depth.height), "",
              "register colour to depth: the same pixel must be the same ray");
}

/// Converts an uncompressed image. `stride`: bytes from one row to the next, 0 if there are no gaps; `channels`: bytes
/// per pixel; `red`: index of the red byte in a pixel.
Result<Image<Rgb>> raw_colour(WireBytes data, ImageSize size, std::int64_t stride, int channels, int red) {
  // Check that all rows lie within the data.
  if (auto possible = check_image_size(size.width, size.height); !possible) return tl::unexpected(possible.error());
  const std::int64_t row = static_cast<std::int64_t>(size.width) * channels;
  if (stride == 0) stride = row;
  if (stride < row || stride > static_cast<std::int64_t>(data.size()) ||
      stride * (size.height - 1) + row > static_cast<std::int64_t>(data.size())) {
    return fail("raw colour of the wrong size");
  }

  // Convert the image pixel by pixel; a grey image has one channel for all three colours.
  Image<Rgb> colour(size.width, size.height);
  const int green = channels == 1 ? 0 : 1, blue = channels == 1 ? 0 : 2 - red;
  for (int v = 0; v < size.height; ++v) {
    const std::uint8_t* pixel = data.data() + v * stride;
    for (int u = 0; u < size.width; ++u, pixel += channels) colour.at(u, v) = {pixel[red], pixel[green], pixel[blue]};
  }
  return colour;
}

Result<Image<Rgb>> kinect_colour(const kinect::image_msg_t& image, ImageSize size) {
  if (image.image_data_format == kinect::image_msg_t::VIDEO_NONE) return Image<Rgb>();
  const ImageSize own{image.width, image.height};
  if (own != size) return other_size(own, size);
  if (image.image_data_format == kinect::image_msg_t::VIDEO_RGB_JPEG) return decode_image(image.image_data, size);
  if (image.image_data_format == kinect::image_msg_t::VIDEO_RGB) return raw_colour(image.image_data, size, 0, 3, 0);
  return fail("colour format " + std::to_string(image.image_data_format) + " is not supported", "",
              "record RGB or JPEG");
}

Result<Image<Rgb>> bot_colour(const bot_core::image_t& image, ImageSize size) {
  // The colour image must have the size of the depth image.
  using bot_core::image_t;
  const ImageSize own{image.width, image.height};
  if (own != size) return other_size(own, size);

  // Decode the pixel formats that are known.
  switch (image.pixelformat) {
    case image_t::PIXEL_FORMAT_MJPEG:
      return decode_image(image.data, size);
    case image_t::PIXEL_FORMAT_RGB:
      return raw_colour(image.data, size, image.row_stride, 3, 0);
    case image_t::PIXEL_FORMAT_BGR:
      return raw_colour(image.data, size, image.row_stride, 3, 2);

    // Grey images have a single channel.
    case image_t::PIXEL_FORMAT_GRAY:
      return raw_colour(image.data, size, image.row_stride, 1, 0);
    default:
      return fail("pixel format " + std::to_string(image.pixelformat) + " is not supported", "", "record RGB or JPEG");
  }
}

}  // namespace

Result<std::shared_ptr<RgbdFrame>> decode_kinect(const kinect::frame_msg_t& message, const GivenIntrinsics& camera,
                                                 std::int64_t number) {
  // Refuse formats and compressions of depth that are not known.
  using kinect::depth_msg_t;
  const depth_msg_t& depth = message.depth;
  if (depth.depth_data_format != depth_msg_t::DEPTH_MM && depth.depth_data_format != depth_msg_t::DEPTH_REGISTERED) {
    return fail("depth format " + std::to_string(depth.depth_data_format) + " is not supported", "",
                "record millimetres");
  }
  if (depth.compression != depth_msg_t::COMPRESSION_NONE && depth.compression != depth_msg_t::COMPRESSION_ZLIB) {
    return fail("depth compression " + std::to_string(depth.compression) + " is not supported");
  }

  // Decode depth and colour.
  const auto encoding = depth.compression == depth_msg_t::COMPRESSION_ZLIB ? DepthEncoding::zlib : DepthEncoding::raw16;
  return make_frame(message.timestamp, number, camera,
                    decode_depth(depth.depth_data, encoding, depth.width, depth.height),
                    kinect_colour(message.image, {depth.width, depth.height}));
}

Result<std::shared_ptr<RgbdFrame>> decode_images(const bot_core::images_t& message, const GivenIntrinsics& camera,
                                                 std::int64_t number) {
  // Define how an image of a given type is found in the message.
  using bot_core::images_t;
  const auto find = [&](std::int16_t type) {
    const auto at = std::find(message.image_types.begin(), message.image_types.end(), type);
    return at == message.image_types.end()
               ? nullptr
               : &message.images[static_cast<std::size_t>(at - message.image_types.begin())];
  };

  // Prefer raw depth over compressed depth.
  const bot_core::image_t* raw = find(images_t::DEPTH_MM);
  const bot_core::image_t* zipped = find(images_t::DEPTH_MM_ZIPPED);
  const bot_core::image_t* depth = raw != nullptr ? raw : zipped;
  if (depth == nullptr) return fail("message without a depth image in millimetres");
  const auto encoding = raw != nullptr ? DepthEncoding::raw16 : DepthEncoding::zlib;

  // The left image of a stereo camera gives the colour, if there is one.
  const bot_core::image_t* left = find(images_t::LEFT);
  auto colour = left != nullptr ? bot_colour(*left, {depth->width, depth->height}) : Image<Rgb>();
  return make_frame(message.utime, number, camera, decode_depth(depth->data, encoding, depth->width, depth->height),
                    std::move(colour));
}

}  // namespace barehand
