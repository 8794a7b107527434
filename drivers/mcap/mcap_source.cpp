// Replays the depth and colour images of an MCAP file.
#include "drivers/mcap/mcap_source.h"

#include <algorithm>
#include <cstdlib>

#include "core/glob.h"
#include "core/quote.h"
#include "io/recording/colour_pairs.h"
#include "io/recording/image_codec.h"
#include "io/ros/cdr.h"
#include "io/ros/ros_frame.h"
#include "io/ros/ros_time.h"
#include "io/ros/ros_topics.h"
#include "sensor/frame_order.h"

namespace barehand {
namespace {

/// The first fields of an image message, which are decoded without its pixels.
struct ImageHead {
  ros::Header header;
  std::uint32_t height = 0, width = 0;
  std::string encoding;
  static constexpr const char* kType = ros::Image::kType;
  static void fields(auto& v, auto& m) {
    v("header", m.header), v("height", m.height), v("width", m.width), v("encoding", m.encoding);
  }
};

/// The namespace of a topic: "/camera/depth" for "/camera/depth/image_raw".
std::string namespace_of(const std::string& topic) { return topic.substr(0, topic.rfind('/')); }

bool is_packed_depth(const std::string& format) { return format.find("compressedDepth") != std::string::npos; }

/// Size of the header before the PNG in an image of the format compressedDepth [bytes].
constexpr std::size_t kPackedDepthHeader = 12;

/// A number in the channel's metadata; 0 if there is none.
double number_in(const mcap::Channel& channel, const char* key) {
  const auto found = channel.metadata.find(key);
  return found == channel.metadata.end() ? 0 : std::strtod(found->second.c_str(), nullptr);
}

/// The depth unit [m]: the one that this program has stored, or else a millimetre, the convention of ROS.
double depth_unit_of(const mcap::Channel& channel) {
  const double unit = number_in(channel, ros::kDepthUnit);
  return unit >= 1e-7 && unit <= 1 ? unit : 0.001;
}

}  // namespace

Result<std::unique_ptr<McapSource>> McapSource::open(const std::string& path, const McapOptions& options) {
  if (options.step == 0)
    return fail("a step of 0 would repeat one frame without end", path, "use 1, or -1 to play backwards");

  // Register all messages of the file.
  std::unique_ptr<McapSource> source(new McapSource(path, options));
  auto reader = mcap::McapReader::open(path, [&](const auto& message, const auto& channel, auto bytes) {
    source->add_message(message, channel, bytes);
  });
  if (!reader) return tl::unexpected(reader.error());
  source->reader_ = std::move(*reader);
  source->warnings_ = source->reader_->warnings();
  if (auto chosen = source->choose(); !chosen) return tl::unexpected(chosen.error());

  // Start at the frame that was asked for.
  const auto count = static_cast<std::int64_t>(source->frames_.size());
  source->position_ = ReplayPosition(options.start, options.step, count);
  if (source->position_.at_end())
    return fail("there is no frame " + std::to_string(source->position_.next()), path,
                "the file holds frames 0 to " + std::to_string(count - 1));
  return source;
}

McapSource::Stream McapSource::begin_stream(const mcap::Channel& channel, std::span<const std::uint8_t> bytes) {
  Stream stream;
  stream.type = channel.type;

  // Streams in other encodings than CDR are not read.
  if (channel.encoding != "cdr") return stream;
  if (channel.type == ros::schema_name<ros::CameraInfo>()) stream.kind = Kind::camera;

  // For a raw image, distinguish depth from colour by its encoding.
  if (channel.type == ros::schema_name<ros::Image>()) {
    const auto head = ros::decode<ImageHead>(bytes);
    if (!head) return stream;
    const std::string& encoding = head->encoding;
    if (encoding == "16UC1" || encoding == "mono16") stream.kind = Kind::depth;
    if (encoding == "rgb8" || encoding == "bgr8") stream.kind = Kind::colour;

    // The frame and the size tell later whether colour and depth belong together.
    stream.type += " in " + encoding;
    stream.frame_id = head->header.frame_id;
    stream.width = static_cast<int>(head->width);
    stream.height = static_cast<int>(head->height);
  }

  // For a compressed image, distinguish them by its format, and read its size from the compressed data.
  if (channel.type == ros::schema_name<ros::CompressedImage>()) {
    const auto image = ros::decode<ros::CompressedImage>(bytes);
    if (!image) return stream;
    stream.kind = is_packed_depth(image->format) ? Kind::packed_depth : Kind::packed_colour;
    stream.type += " in " + image->format;
    stream.frame_id = image->header.frame_id;

    // The size stays empty if it cannot be read.
    const auto size = compressed_image_size(image->data).value_or(ImageSize{});
    stream.width = size.width;
    stream.height = size.height;
  }
  return stream;
}

/// Registers a message; called for every message in the order of the file.
void McapSource::add_message(const mcap::Message& message, const mcap::Channel& channel,
                             std::span<const std::uint8_t> bytes) {
  // Find the stream of this topic, or begin it.
  auto known = streams_.find(channel.topic);
  if (known == streams_.end()) known = streams_.emplace(channel.topic, begin_stream(channel, bytes)).first;
  Stream& stream = known->second;
  if (stream.kind == Kind::other) return;
  const auto header = ros::decode<ros::Header>(bytes);
  const std::int64_t utime = header ? ros::utime_of(header->stamp) : static_cast<std::int64_t>(message.log_time / 1000);

  if (stream.kind == Kind::camera) {
    const auto info = ros::decode<ros::CameraInfo>(bytes);
    if (const auto camera = info ? ros::camera_of(*info) : tl::unexpected(info.error())) {
      stream.cameras[utime] = *camera;
      stream.lens |= std::any_of(info->d.begin(), info->d.end(), [](double d) { return d != 0; });
    }
    return;
  }

  // Store the position of an image message in the file, and its time.
  stream.messages.push_back(message);
  stream.utimes.push_back(utime);
}

std::string McapSource::topics() const {
  std::vector<std::string> names;
  for (const auto& [topic, stream] : streams_) names.push_back(topic + " (" + stream.type + ")");
  return names.empty() ? "none" : comma_list(names);
}

Result<void> McapSource::choose() {
  // Choose the topics with depth images that match the option.
  std::vector<std::string> chosen;
  for (const auto& [topic, stream] : streams_) {
    const bool depth = stream.kind == Kind::depth || stream.kind == Kind::packed_depth;
    if (depth && (options_.channel.empty() || topic == options_.channel || matches_glob(options_.channel, topic)))
      chosen.push_back(topic);
  }

  // Fail if the file has no readable message, or if no topic with depth images matches.
  if (streams_.empty())
    return fail("holds no message that can be read", path_,
                warnings_.empty() ? "it is empty, damaged or cut short before its first chunk" : warnings_.back());
  if (chosen.empty() && !options_.channel.empty())
    return fail("no topic with depth images matches " + in_quotes(options_.channel) + "; its topics are " + topics(),
                path_);
  if (chosen.empty())
    return fail("holds no depth images that are read; its topics are " + topics(), path_,
                "known are sensor_msgs/msg/Image in 16UC1 and CompressedImage in compressedDepth, in CDR");

  // The choice is ambiguous if several topics hold depth and none was named.
  if (chosen.size() > 1 && options_.channel.empty())
    return fail("holds depth images on several topics: " + comma_list(chosen), path_,
                "choose one: run.frame_channel in the configuration of track, --channel " + shell_word(chosen[0]) +
                    " for record and convert");

  // Add the frames of the chosen topics.
  for (const std::string& topic : chosen)
    if (auto added = add_frames(topic); !added) return added;

  // Sort the frames of several topics in the order in which they were recorded.
  std::stable_sort(frames_.begin(), frames_.end(), [](const Frame& a, const Frame& b) {
    return std::pair(a.depth.chunk, a.depth.offset) < std::pair(b.depth.chunk, b.depth.offset);
  });
  return {};
}

const McapSource::Stream* McapSource::camera_of(const std::string& topic) const {
  const auto found = streams_.find(namespace_of(topic) + "/camera_info");
  return found == streams_.end() || found->second.cameras.empty() ? nullptr : &found->second;
}

/// The colour stream that is registered to a depth topic: with the same frame_id and image size. Null: there is none;
/// if there is other colour, this adds a warning. (The size of packed depth is not known here.)
const McapSource::Stream* McapSource::colour_of(const std::string& topic) {
  // Use the first colour stream that has the frame and the size of the depth.
  const Stream& depth = streams_.at(topic);
  std::vector<std::string> others;
  for (const auto& [other, stream] : streams_) {
    if (stream.kind != Kind::colour && stream.kind != Kind::packed_colour) continue;
    const bool same_size =
        depth.kind == Kind::packed_depth || (stream.width == depth.width && stream.height == depth.height);
    if (stream.frame_id == depth.frame_id && same_size) return &stream;
    others.push_back(other);
  }

  // Warn about colour streams that cannot be used with this depth.
  if (!others.empty())
    warnings_.push_back(path_ + ": the colour of " + comma_list(others) +
                        " has another frame or size than the depth of " + topic +
                        ", so it is not used: record colour that is registered to depth");
  return nullptr;
}

Result<void> McapSource::add_frames(const std::string& topic) {
  // Find the intrinsics of this topic.
  const auto& [name, depth] = *streams_.find(topic);
  const Stream* camera = camera_of(topic);
  if (camera == nullptr && !options_.foreign.any())
    return fail("there are no intrinsics for " + topic + ": no camera info on " + namespace_of(topic) + "/camera_info",
                path_,
                "give them: foreign_camera in the configuration, or --fx, --fy, --cx, --cy of record and convert");
  if (camera != nullptr && camera->lens)
    warnings_.push_back(path_ + ": the coefficients of lens distortion in " + namespace_of(topic) +
                        "/camera_info are not used: record rectified images where they matter");

  // Pair each depth image with a colour image.
  const Stream* colour = colour_of(topic);
  const ColourPairs pairs = pair_colour(depth.utimes, colour != nullptr ? colour->utimes : std::vector<std::int64_t>());

  // Add the frames with their colour and their numbers.
  FrameOrder order(StampUnit::microseconds);
  for (std::size_t i = 0; i < depth.messages.size(); ++i) {
    Frame frame{&name, depth.messages[i], {}, depth.utimes[i], 0, {}};
    if (pairs.colour[i]) frame.colour = colour->messages[*pairs.colour[i]];
    const mcap::Channel& channel = reader_->channels().at(frame.depth.channel);
    const bool own = channel.metadata.contains(ros::kDepthUnit);

    // Number the frame, or store the reason why it is not used.
    const auto position = static_cast<std::int64_t>(i);
    const auto number = order.number(frame.utime, own ? frame.depth.sequence : position);
    if (number)
      frame.number = *number;
    else
      frame.fault = number.error().message();

    // Take the frame rate from the metadata, if it is plausible.
    if (const double fps = number_in(channel, ros::kFps); fps > 0 && fps < 10'000) fps_ = fps;
    frames_.push_back(std::move(frame));
  }
  for (const std::string& warning : order.take_last_warnings())
    warnings_.push_back(path_ + " " + topic + ": " + warning);
  return {};
}

SourceEvent McapSource::next(std::chrono::milliseconds) {
  const auto position = position_.take();
  if (!position) return EndOfStream{};
  return read(*position);
}

SourceEvent McapSource::read(std::int64_t position) {
  const Frame& frame = frames_[static_cast<std::size_t>(position)];
  const std::string where = path_ + " frame " + std::to_string(position) + " (" + *frame.topic + ")";
  if (!frame.fault.empty()) return SkippedFrame{{frame.fault, where, ""}};
  auto read = read_frame(frame);
  if (read) return *std::move(read);
  return SkippedFrame{{read.error().what, where, read.error().remedy}};
}

Result<FramePtr> McapSource::read_frame(const Frame& item) {
  // Decode the depth, and describe the frame.
  auto depth = read_depth(item);
  if (!depth) return tl::unexpected(depth.error());
  const mcap::Channel& channel = reader_->channels().at(item.depth.channel);
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = item.utime;
  frame->number = item.number;
  frame->depth_unit = depth_unit_of(channel);
  if (const auto sensor = channel.metadata.find(ros::kSensor); sensor != channel.metadata.end())
    frame->sensor = sensor->second;

  // Take the newest intrinsics that are not newer than the image, or the first ones if all are newer.
  if (const Stream* stream = camera_of(*item.topic)) {
    const auto after = stream->cameras.upper_bound(item.utime);
    frame->camera = (after == stream->cameras.begin() ? after : std::prev(after))->second;
  } else {
    frame->camera = options_.foreign.of_size(depth->width(), depth->height());
  }
  if (depth->width() != frame->camera.width || depth->height() != frame->camera.height)
    return fail("the depth image and its camera info differ in size");
  frame->depth = std::move(*depth);

  // If the colour cannot be read, the frame is delivered without it: tracking needs depth only.
  if (!item.colour) return frame;
  if (auto colour = read_colour(item, frame->camera))
    frame->colour = std::move(*colour);
  else
    frame->colour_fault = colour.error().message();
  return frame;
}

Result<Image<std::uint16_t>> McapSource::read_depth(const Frame& frame) {
  const auto bytes = reader_->read(frame.depth);
  if (!bytes) return tl::unexpected(bytes.error());
  if (streams_.at(*frame.topic).kind == Kind::depth)
    return ros::decode<ros::Image>(*bytes).and_then([](const ros::Image& image) { return ros::depth_of(image); });
  return ros::decode<ros::CompressedImage>(*bytes).and_then([](const ros::CompressedImage& image) {
    const std::span<const std::uint8_t> data(image.data);
    return decode_depth_image(data.subspan(std::min(kPackedDepthHeader, data.size())));
  });
}

Result<Image<Rgb>> McapSource::read_colour(const Frame& frame, const Intrinsics& camera) {
  const auto bytes = reader_->read(*frame.colour);
  if (!bytes) return tl::unexpected(bytes.error());
  if (reader_->channels().at(frame.colour->channel).type == ros::schema_name<ros::CompressedImage>())
    return ros::decode<ros::CompressedImage>(*bytes).and_then([&](const ros::CompressedImage& image) {
      return decode_image(image.data, {camera.width, camera.height});
    });
  auto colour = ros::decode<ros::Image>(*bytes).and_then([](const ros::Image& image) { return ros::colour_of(image); });
  if (colour && (colour->width() != camera.width || colour->height() != camera.height))
    return fail("the colour image and the depth image differ in size");
  return colour;
}

}  // namespace barehand
