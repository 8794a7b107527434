// Finds the frames of hand states in logs.
#include "app/view/log_index.h"

#include <algorithm>
#include <map>

#include "drivers/lcm/layouts.h"
#include "io/lcm/log_names.h"

namespace barehand {

Result<LogIndex> LogIndex::open(const std::vector<std::string>& paths) {
  // Open every log, those of sets and folders too.
  LogIndex index;
  std::string names;
  for (const std::string& path : paths) {
    const auto files = find_logs(path);
    if (!files) return tl::unexpected(files.error());
    for (const std::string& file : files->files)
      if (const auto added = index.add(file); !added) return tl::unexpected(added.error());
    names.append(names.empty() ? "" : ", ").append(path);
  }

  // Find the frames that can be shown.
  index.find_frames();
  if (index.frames_.empty())
    return fail("it holds neither hand states nor frames", names,
                "write a log of states with barehand track --states-log FILE, or --mcap FILE");
  index.find_lost();
  return index;
}

Result<void> LogIndex::add(const std::string& path) {
  auto log = MessageLog::open(path);
  if (!log) return tl::unexpected(log.error());
  warnings_.insert(warnings_.end(), log->warnings().begin(), log->warnings().end());

  // An MCAP file may have images without hands, such as a bag of ROS, or hands without images.
  std::unique_ptr<McapSource> images;
  if (log->is_mcap()) {
    auto source = McapSource::open(path);
    if (!source && log->entries().empty()) return tl::unexpected(source.error());
    if (source)
      images = std::move(*source);
    else
      warnings_.push_back("no images are shown: " + source.error().message());
  }
  logs_.push_back({std::move(*log), std::move(images)});
  return {};
}

/// Finds the frames: all times with a hand state, or, if there are no states, all times with an image or with another
/// message about hands or objects.
void LogIndex::find_frames() {
  // Collect what the logs hold, by time.
  std::map<std::int64_t, Frame> of_time;
  for (std::size_t log = 0; log < logs_.size(); ++log) {
    const std::vector<LogEntry>& entries = logs_[log].messages.entries();
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const MessageKind kind = kind_of(entries[k].hash);
      if (kind == MessageKind::other || kind == MessageKind::health) continue;
      Frame& frame = of_time[entries[k].utime];
      frame.places.push_back({log, k});
      frame.any_state |= kind == MessageKind::hand_state;
      frame.any_image |= kind == MessageKind::frame;
      any_states_ |= frame.any_state;
    }
    const std::int64_t images = logs_[log].images ? logs_[log].images->frames() : 0;
    for (std::int64_t k = 0; k < images; ++k) {
      Frame& frame = of_time[logs_[log].images->utime(k)];
      frame.image = {log, k};
      frame.any_image = true;
    }
  }

  // Keep the frames that are to be shown.
  bool any_images = false, any_shown = false;
  for (auto& [utime, frame] : of_time) {
    any_images |= frame.any_image;
    if (any_states_ && !frame.any_state) continue;
    any_shown |= frame.any_image;
    frame.utime = utime;
    frames_.push_back(std::move(frame));
  }
  if (any_images && !any_shown)
    warnings_.emplace_back(
        "no images are shown: none has the time of a hand state; give states and images of the same recording");
}

void LogIndex::find_lost() {
  for (std::int64_t i = 0; any_states_ && i < frames(); ++i) {
    if (has_pose(frames_[static_cast<std::size_t>(i)])) continue;
    if (!lost_.empty() && lost_.back().last == i - 1)
      lost_.back().last = i;
    else
      lost_.push_back({i, i});
  }
}

bool LogIndex::has_pose(const Frame& frame) {
  for (const Place& place : frame.places) {
    const LogEntry& entry = logs_[place.log].messages.entries()[place.entry];
    if (kind_of(entry.hash) != MessageKind::hand_state) continue;
    const auto bytes = logs_[place.log].messages.read(entry);
    const auto state = bytes ? decode_message<hand_state_t>(*bytes) : tl::unexpected(bytes.error());
    if (state && state->has_pose) return true;
  }
  return false;
}

double LogIndex::seconds(std::int64_t frame) const {
  return static_cast<double>(frames_[static_cast<std::size_t>(frame)].utime - frames_.front().utime) * 1e-6;
}

std::vector<ReceivedMessage> LogIndex::messages(std::int64_t frame) {
  std::vector<ReceivedMessage> messages;
  for (const Place& place : frames_[static_cast<std::size_t>(frame)].places) {
    const LogEntry& entry = logs_[place.log].messages.entries()[place.entry];
    if (auto bytes = logs_[place.log].messages.read(entry)) messages.push_back({entry.channel, std::move(*bytes)});
  }
  return messages;
}

FramePtr LogIndex::image(std::int64_t frame) {
  const auto& place = frames_[static_cast<std::size_t>(frame)].image;
  if (!place) return nullptr;
  const SourceEvent event = logs_[place->log].images->read(place->frame);
  const auto* image = std::get_if<FramePtr>(&event);
  return image ? *image : nullptr;
}

}  // namespace barehand
