// Replays the frames of LCM logs.
#include "drivers/lcm/lcm_log_source.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "barehand/rgbd_frame_t.hpp"
#include "core/glob.h"
#include "core/quote.h"
#include "drivers/lcm/frame_message.h"
#include "io/atomic_file.h"
#include "io/lcm/log_names.h"
#include "sensor/frame_order.h"

namespace barehand {
namespace {

/// The remedy in an error message: how to choose a channel.
std::string how_to_choose(const std::string& channel) {
  return "choose one: run.frame_channel: " + in_quotes(channel) + " in the configuration of track, --channel " +
         shell_word(channel) + " for record and convert";
}

std::string names(const std::set<std::string>& channels) {
  std::vector<std::string> names;
  for (const std::string& channel : channels) names.push_back(in_quotes(channel));
  return comma_list(names);
}

}  // namespace

Result<std::unique_ptr<LcmLogSource>> LcmLogSource::open(const std::string& path, const LcmLogOptions& options) {
  // Check the options, open the files and choose the channels.
  if (options.step == 0)
    return fail("a step of 0 would repeat one frame without end", path, "use 1, or -1 to play backwards");
  std::unique_ptr<LcmLogSource> source(new LcmLogSource(path, options));
  if (auto ready = source->open_files().and_then([&] { return source->choose(); }); !ready)
    return tl::unexpected(ready.error());

  // Start at the frame that was asked for.
  const auto count = static_cast<std::int64_t>(source->frames_.size());
  source->position_ = ReplayPosition(options.start, options.step, count);
  if (source->position_.at_end()) {
    return fail("there is no frame " + std::to_string(source->position_.next()), path,
                "the log holds frames 0 to " + std::to_string(count - 1));
  }
  source->put_in_order();
  return source;
}

Result<void> LcmLogSource::open_files() {
  // Find the files of the log.
  auto logs = find_logs(path_);
  if (!logs) return tl::unexpected(logs.error());
  left_out_ = std::move(logs->left_out);

  // Find the events of each file, and leave out files that cannot be read.
  for (const std::string& file : logs->files) {
    auto reader = LcmLogReader::open(file);
    if (reader && reader->entries().empty()) reader = fail("is not an LCM log: it holds no complete event", file);
    if (!reader) {
      left_out_.push_back(reader.error());
      continue;
    }

    // Collect the events; the files are opened again when they are played.
    for (const LogEntry& entry : reader->entries()) frames_.push_back({files_.size(), entry, 0});
    if (file != path_ && !finished_name(file).empty())
      warnings_.push_back(file + ": was left by a killed recorder; every complete event is played");
    reader->close();
    files_.push_back(std::move(*reader));
  }

  // Without any event, the first fault is the result.
  if (frames_.empty()) return tl::unexpected(left_out_.front());
  return {};
}

/// Keeps the events of the channels that were asked for or, if none were, of the only channel with frames.
Result<void> LcmLogSource::choose() {
  const std::string& pattern = options_.channel;

  std::set<std::string> all;
  for (const Event& event : frames_) all.insert(event.entry.channel);

  // Keep the events of the channels that match the pattern, or all frames if there is none.
  const bool is_name = all.contains(pattern);
  std::erase_if(frames_, [&](const Event& event) {
    const std::string& channel = event.entry.channel;
    if (pattern.empty()) return !carries_frames(event.entry.hash);
    return is_name ? channel != pattern : !matches_glob(pattern, channel);
  });
  std::set<std::string> with_frames;
  for (const Event& event : frames_)
    if (carries_frames(event.entry.hash)) with_frames.insert(event.entry.channel);

  // Report it if the channel is ambiguous or nothing matches: frames of two sensors are not one sequence.
  if (pattern.empty() && with_frames.empty()) {
    return fail("the log holds no frames; its channels are " + names(all), path_,
                "known types are barehand.rgbd_frame_t, kinect.frame_msg_t and bot_core.images_t");
  }
  if (!is_name && with_frames.size() > 1) {
    return fail("the log holds frames on several channels: " + names(with_frames), path_,
                how_to_choose(*with_frames.begin()));
  }

  // A pattern must match at least one channel.
  if (frames_.empty()) return fail("no channel matches " + in_quotes(pattern) + "; there are " + names(all), path_);
  return {};
}

/// Numbers the frames in the order of their recording, in whichever direction they are played.
void LcmLogSource::put_in_order() {
  std::map<std::string, FrameOrder> orders;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    Event& event = frames_[i];
    if (!carries_frames(event.entry.hash)) continue;
    const auto position = static_cast<std::int64_t>(i);
    const bool own = event.entry.hash == rgbd_frame_t::getHash();
    FrameOrder& order = orders.try_emplace(event.entry.channel, StampUnit::microseconds).first->second;
    const auto number = order.number(event.entry.utime, own ? event.entry.third : position);

    // Keep the number, or note why the frame is skipped.
    if (number)
      event.number = *number;
    else
      unused_.emplace(position, number.error());
  }

  // Report the warnings of every channel.
  for (auto& [channel, order] : orders)
    for (const std::string& warning : order.take_last_warnings())
      warnings_.push_back(path_ + " " + channel + ": " + warning);
}

std::int64_t LcmLogSource::damaged_bytes() const {
  std::int64_t bytes = 0;
  for (const LcmLogReader& file : files_) bytes += file.damaged_bytes();
  return bytes;
}

double LcmLogSource::fps() const {
  // Collect the times between two frames. Frames of several channels may have the same time.
  std::vector<std::int64_t> steps_us;
  for (std::size_t i = 1; i < frames_.size(); ++i)
    if (const std::int64_t step_us = frames_[i].entry.utime - frames_[i - 1].entry.utime; step_us > 0)
      steps_us.push_back(step_us);
  if (steps_us.empty()) return 0;

  // The median is not affected by pauses and missing frames.
  const auto middle = steps_us.begin() + static_cast<std::ptrdiff_t>(steps_us.size() / 2);
  std::ranges::nth_element(steps_us, middle);
  return std::round(1e8 / static_cast<double>(*middle)) / 100;
}

SourceEvent LcmLogSource::next(std::chrono::milliseconds) {
  const auto position = position_.take();
  if (!position) return EndOfStream{};
  return read(*position);
}

SourceEvent LcmLogSource::read(std::int64_t position) {
  const auto& [file, entry, number] = frames_[static_cast<std::size_t>(position)];
  const std::string where = path_ + " frame " + std::to_string(position) + " (" + entry.channel + ")";
  const auto skipped = [&](Error error) {
    error.where = where;
    return SkippedFrame{std::move(error)};
  };

  // Skip a frame whose time stamp cannot be used.
  if (const auto unused = unused_.find(position); unused != unused_.end()) return skipped(unused->second);

  // Keep only one file open at a time.
  if (file != open_) files_[open_].close();
  open_ = file;
  const auto message = files_[file].read(entry);
  if (!message) return SourceFailed{message.error()};

  // Decode the frame, and give it its number.
  auto frame = decode_frame_message(*message, options_.foreign, number);
  if (!frame) return skipped(frame.error());
  (*frame)->number = number;
  return FramePtr(*std::move(frame));
}

}  // namespace barehand
