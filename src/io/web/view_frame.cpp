// Encodes a frame and its hands for the live page.
#include "io/web/view_frame.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "io/recording/jpeg_codec.h"
#include "io/web/view_bytes.h"

namespace barehand {
namespace {

constexpr int kJpegQuality = 75;

/// Packs a colour into 16 bits: 5 for red, 6 for green, 5 for blue.
std::uint16_t rgb565(const Rgb& c) { return static_cast<std::uint16_t>((c.r >> 3) << 11 | (c.g >> 2) << 5 | c.b >> 3); }

/// The smallest distance of the grid points [px] with which the grid has at most `most` points.
int grid_step(const ViewFocus& part, int most) {
  int step = 1;
  while ((part.width / step) * (part.height / step) > most) ++step;
  return step;
}

ViewFocus everything(const Intrinsics& camera) { return {0, 0, camera.width, camera.height, 0, 1e9}; }

std::vector<std::uint8_t> cloud_chunk(const RgbdFrame& frame, const ViewFocus& part) {
  // Choose the grid of pixels that represents the part.
  const int step = grid_step(part, ViewFrame::kMaxPoints), columns = part.width / step, rows = part.height / step;
  const int first_u = part.u + step / 2, first_v = part.v + step / 2;
  std::vector<std::uint8_t> bytes;
  if (columns == 0 || rows == 0 || frame.depth.empty()) return bytes;

  // Write the grid and the unit of depth.
  const bool coloured = !frame.colour.empty();
  bytes.reserve(32 + static_cast<std::size_t>(columns) * rows * (coloured ? 4 : 2));
  ChunkWriter out(bytes);
  out.begin('D', coloured ? 1 : 0);
  for (const int number : {columns, rows, step, first_u, first_v, 0}) out.put(static_cast<std::uint16_t>(number));
  out.put(static_cast<float>(frame.depth_unit));

  // Take one pixel for each cell, not the mean of several: a mean across a depth edge would lie on no surface.
  const double near = part.near / frame.depth_unit, far = part.far / frame.depth_unit;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::uint16_t depth = frame.depth.at(first_u + step * i, first_v + step * j);
      out.put(depth >= near && depth <= far ? depth : std::uint16_t{0});
    }

  // Add the colours of the same pixels.
  if (coloured)
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) out.put(rgb565(frame.colour.at(first_u + step * i, first_v + step * j)));
  out.end();
  return bytes;
}

/// The image reduced to every n-th pixel, so that it is at most `width` pixels wide.
Image<Rgb> shrunk(const Image<Rgb>& image, int width) {
  const int step = (image.width() + width - 1) / width;
  if (step <= 1) return image;
  Image<Rgb> small(image.width() / step, image.height() / step);
  for (int v = 0; v < small.height(); ++v)
    for (int u = 0; u < small.width(); ++u) small.at(u, v) = image.at(u * step, v * step);
  return small;
}

std::vector<std::uint8_t> picture_chunk(const Image<Rgb>& image, ViewPicture kind, int width) {
  std::vector<std::uint8_t> bytes;
  if (image.empty()) return bytes;
  const auto jpeg = encode_jpeg(shrunk(image, width), kJpegQuality);
  if (!jpeg) return bytes;
  ChunkWriter out(bytes);
  out.begin('P', static_cast<int>(kind));
  out.put_bytes(*jpeg);
  out.end();
  return bytes;
}

}  // namespace

std::optional<ViewFocus> focus_on(std::span<const Eigen::Vector3d> points, const Intrinsics& camera) {
  // The rectangle and the range of depths around the points.
  // Margins beside, in front of and behind the points [m], so that an object in the hand is included.
  constexpr double kBeside = 0.06, kBefore = 0.1, kBehind = 0.12;
  double left = camera.width, right = 0, top = camera.height, bottom = 0;
  double near = std::numeric_limits<double>::infinity(), far = 0;
  for (const Eigen::Vector3d& point : points) {
    if (!point.allFinite() || point.z() <= 0) continue;

    // Extend the rectangle around the pixel by a margin of constant size in space.
    const Eigen::Vector2d pixel = camera.project(point);
    const double margin = kBeside * camera.fx / point.z();
    left = std::min(left, pixel.x() - margin);
    right = std::max(right, pixel.x() + margin);
    top = std::min(top, pixel.y() - margin);
    bottom = std::max(bottom, pixel.y() + margin);

    // Extend the range of depths.
    near = std::min(near, point.z());
    far = std::max(far, point.z());
  }

  // Clip the rectangle to the image.
  const auto inside = [](double value, int size) { return static_cast<int>(std::clamp(value, 0.0, double(size))); };
  const int u = inside(left, camera.width), v = inside(top, camera.height);
  const ViewFocus focus{
      u, v, inside(right, camera.width) - u, inside(bottom, camera.height) - v, near - kBefore, far + kBehind};
  if (focus.width <= 0 || focus.height <= 0) return std::nullopt;
  return focus;
}

void ViewFrame::write_states(std::int64_t now, std::vector<std::uint8_t>& out) const {
  // Write the times and the camera of the frame.
  ChunkWriter chunk(out);
  chunk.begin('F');
  for (const std::int64_t time : {content_.utime, content_.number, now}) chunk.put(time);
  const Intrinsics camera = content_.frame ? content_.frame->camera : Intrinsics{};
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy}) chunk.put(value);
  for (const int size : {camera.width, camera.height}) chunk.put(static_cast<std::int32_t>(size));
  chunk.end();

  // Write the place in the log with the frame itself, since a status may come long before a slow client has the frame.
  if (content_.place) {
    chunk.begin('T');
    chunk.put(content_.place->position);
    chunk.put(content_.place->seconds);
    chunk.end();
  }

  // Write each message under the name of its channel.
  for (const ViewMessage& message : content_.messages) {
    const std::size_t name = std::strlen(message.channel);
    chunk.begin('L');
    chunk.put(static_cast<std::uint8_t>(name));
    chunk.put_bytes({reinterpret_cast<const std::uint8_t*>(message.channel), name});
    chunk.put_bytes(message.bytes);
    chunk.end();
  }
}

std::span<const std::uint8_t> ViewFrame::cloud(ViewCloud kind) const {
  if (kind == ViewCloud::none || !content_.frame) return {};
  const RgbdFrame& frame = *content_.frame;
  const bool hand = kind == ViewCloud::hand && content_.focus;
  Made& made = hand ? hand_cloud_ : scene_cloud_;
  std::call_once(made.flag,
                 [&] { made.bytes = cloud_chunk(frame, hand ? *content_.focus : everything(frame.camera)); });
  return made.bytes;
}

std::span<const std::uint8_t> ViewFrame::picture(ViewPicture kind, bool large) const {
  if (kind == ViewPicture::none || !content_.frame) return {};
  Made& made = pictures_[kind == ViewPicture::depth ? 1 : 0][large ? 1 : 0];
  std::call_once(made.flag, [&] {
    const RgbdFrame& frame = *content_.frame;
    const int width = large ? kLargeWidth : kSmallWidth;
    if (kind == ViewPicture::colour)
      made.bytes = picture_chunk(frame.colour, kind, width);
    else
      made.bytes = picture_chunk(depth_colours(frame, content_.depths), kind, width);
  });
  return made.bytes;
}

}  // namespace barehand
