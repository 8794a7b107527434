#include "drivers/lcm/lcm_log_source.h"

#include <fnmatch.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "drivers/lcm/frame_message.h"

namespace barehand {
namespace {

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Events of the channels that the pattern chooses; of the one channel with frames if there is no pattern.
Result<std::vector<LogEntry>> choose(std::vector<LogEntry> entries, const std::string& pattern,
                                     const std::string& path) {
  std::set<std::string> all, with_frames;
  for (const LogEntry& entry : entries) {
    all.insert(entry.channel);
    if (carries_frames(entry.hash)) with_frames.insert(entry.channel);
  }
  const auto unwanted = [&](const LogEntry& entry) {
    return pattern.empty() ? !carries_frames(entry.hash) : fnmatch(pattern.c_str(), entry.channel.c_str(), 0) != 0;
  };
  std::erase_if(entries, unwanted);
  if (pattern.empty() && with_frames.empty()) {
    return fail("the log holds no frames; its channels are " + joined(all), path,
                "known types are barehand.rgbd_frame_t, kinect.frame_msg_t and bot_core.images_t");
  }
  if (pattern.empty() && with_frames.size() > 1) {
    return fail("the log holds frames on several channels: " + joined(with_frames), path, "choose one");
  }
  if (entries.empty()) return fail("no channel matches \"" + pattern + "\"; there are " + joined(all), path);
  return entries;
}

/// Frames whose time is not later than that of every frame before them on their channel.
std::vector<bool> find_stale(const std::vector<LogEntry>& frames) {
  std::map<std::string, std::int64_t> latest;
  std::vector<bool> stale;
  for (const LogEntry& frame : frames) {
    const auto [at, first] = latest.try_emplace(frame.channel, std::numeric_limits<std::int64_t>::min());
    stale.push_back(!first && carries_frames(frame.hash) && frame.utime <= at->second);
    if (carries_frames(frame.hash)) at->second = std::max(at->second, frame.utime);
  }
  return stale;
}

}  // namespace

Result<std::unique_ptr<LcmLogSource>> LcmLogSource::open(const std::string& path, const LcmLogOptions& options) {
  if (options.step == 0) return fail("a step of 0 plays nothing", path, "use 1, or -1 to play backwards");
  auto reader = LcmLogReader::open(path);
  if (!reader) return tl::unexpected(reader.error());
  auto frames = choose(reader->entries(), options.channel, path);
  if (!frames) return tl::unexpected(frames.error());
  const auto count = static_cast<std::int64_t>(frames->size());
  const std::int64_t start = options.start.value_or(options.step > 0 ? 0 : count - 1);
  if (start < 0 || start >= count) {
    return fail("there is no frame " + std::to_string(start), path,
                "the log holds frames 0 to " + std::to_string(count - 1));
  }
  std::unique_ptr<LcmLogSource> source(new LcmLogSource(path, options, std::move(*reader)));
  source->stale_ = find_stale(*frames);
  source->frames_ = std::move(*frames);
  source->next_ = start;
  return source;
}

std::int64_t LcmLogSource::remaining() const {
  const auto count = static_cast<std::int64_t>(frames_.size());
  if (next_ < 0 || next_ >= count) return 0;
  return options_.step > 0 ? (count - 1 - next_) / options_.step + 1 : next_ / -options_.step + 1;
}

SourceEvent LcmLogSource::next(std::chrono::milliseconds) {
  if (remaining() == 0) return EndOfStream{};
  const std::int64_t position = next_;
  next_ += options_.step;
  return read(position);
}

SourceEvent LcmLogSource::read(std::int64_t position) {
  const LogEntry& entry = frames_[static_cast<std::size_t>(position)];
  const std::string where = path_ + " frame " + std::to_string(position) + " (" + entry.channel + ")";
  if (stale_[static_cast<std::size_t>(position)]) {
    return SkippedFrame{{"its time is not later than that of the frames before", where, ""}};
  }
  const auto message = reader_.read(entry);
  if (!message) return SourceFailed{message.error()};
  auto frame = decode_frame_message(*message, options_.foreign, position);
  if (frame) return *frame;
  Error error = frame.error();
  error.where = where;
  return SkippedFrame{std::move(error)};
}

}  // namespace barehand
