// Finds the frames of hand states in logs.
#include "app/view/log_index.h"

#include <algorithm>
#include <map>

#include "drivers/lcm/layouts.h"
#include "io/lcm/log_names.h"
#include "io/mcap/mcap_reader.h"

namespace barehand {

Result<LogIndex> LogIndex::open(const std::vector<std::string>& paths) {
  // Open every log, those of sets and folders too.
  LogIndex index;
  std::string names;
  for (const std::string& path : paths) {
    const auto files = find_logs(path);
    if (!files) return tl::unexpected(files.error());
    for (const std::string& file : files->files) {
      if (mcap::is_mcap(file))
        return fail("is an MCAP file, which this page does not play", file,
                    "open it in Foxglove or Lichtblick, or convert it to an LCM log: barehand convert");
      auto log = LcmLogReader::open(file);
      if (!log) return tl::unexpected(log.error());
      index.logs_.push_back(std::move(*log));
    }
    names.append(names.empty() ? "" : ", ").append(path);
  }

  // Find the frames that can be shown.
  index.find_frames();
  if (index.frames_.empty())
    return fail("it holds neither hand states nor frames", names,
                "write a log of states with barehand track --states-log FILE");
  index.find_lost();
  return index;
}

/// Finds the frames: all times with a hand state, or, if there are no states, all times with an image or glove values.
void LogIndex::find_frames() {
  std::map<std::int64_t, std::vector<Place>> of_time;
  for (std::size_t log = 0; log < logs_.size(); ++log) {
    const std::vector<LogEntry>& entries = logs_[log].entries();
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const MessageKind kind = kind_of(entries[k].hash);
      any_states_ |= kind == MessageKind::hand_state;
      if (kind != MessageKind::other && kind != MessageKind::health) of_time[entries[k].utime].push_back({log, k});
    }
  }
  for (auto& [utime, places] : of_time) {
    const auto is_state = [&](const Place& place) {
      return kind_of(logs_[place.log].entries()[place.entry].hash) == MessageKind::hand_state;
    };
    if (!any_states_ || std::ranges::any_of(places, is_state)) frames_.push_back({utime, std::move(places)});
  }
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
    const LogEntry& entry = logs_[place.log].entries()[place.entry];
    if (kind_of(entry.hash) != MessageKind::hand_state) continue;
    const auto bytes = logs_[place.log].read(entry);
    const auto state = bytes ? decode_message<hand_state_t>(*bytes) : tl::unexpected(bytes.error());
    if (state && state->has_pose) return true;
  }
  return false;
}

double LogIndex::seconds(std::int64_t frame) const {
  return static_cast<double>(frames_[static_cast<std::size_t>(frame)].utime - frames_.front().utime) * 1e-6;
}

std::vector<LcmMessage> LogIndex::messages(std::int64_t frame) {
  std::vector<LcmMessage> messages;
  for (const Place& place : frames_[static_cast<std::size_t>(frame)].places) {
    const LogEntry& entry = logs_[place.log].entries()[place.entry];
    if (auto bytes = logs_[place.log].read(entry)) messages.push_back({entry.channel, std::move(*bytes)});
  }
  return messages;
}

}  // namespace barehand
