#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

// A reader of LCM logs, which skips damaged parts.

/// A complete event of an LCM log.
struct LogEntry {
  std::int64_t position = 0;   ///< byte offset of the event's header in the file
  std::int64_t timestamp = 0;  ///< the log's own time stamp: when the event was received [us]
  std::string channel;
  std::int32_t size = 0;   ///< size of the message [bytes]
  std::int64_t hash = 0;   ///< the message's type fingerprint; 0 if it is shorter than 8 bytes
  std::int64_t utime = 0;  ///< the message's second 64-bit word: its time stamp [us] in every type that is read here
  std::int64_t third = 0;  ///< the message's third 64-bit word: `seq` in rgbd_frame_t

  static constexpr std::size_t kStart = 24;  ///< size of the beginning that read_start() looks at [bytes]
  /// Sets hash, utime and third from the beginning of the message.
  void read_start(std::span<const std::uint8_t> message);
};

/// Random access to an LCM log. Every length in the file is checked, and damaged events are skipped; liblcm's reader
/// loses the event before a damaged one and allocates as much memory as a damaged length states.
class LcmLogReader {
 public:
  /// Finds every complete event in one pass over the headers, without reading the messages. There may be none. Errors:
  /// a file that cannot be opened or is empty.
  static Result<LcmLogReader> open(const std::string& path);

  const std::vector<LogEntry>& entries() const { return entries_; }  ///< complete events in the order of the file
  /// Number of bytes that belong to no complete event: an incomplete end, damage in the middle. 0 for a healthy log.
  std::int64_t damaged_bytes() const { return damaged_bytes_; }

  /// Reads the message of an event. This fails only if the file changes or the disk breaks.
  Result<std::vector<std::uint8_t>> read(const LogEntry& entry);
  /// Closes the file until the next read(), since thousands of logs cannot be open at once.
  void close() { file_.reset(); }

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, CloseFile>;
  explicit LcmLogReader(std::string path) : path_(std::move(path)) {}
  Result<void> open_file();

  std::string path_;
  File file_;
  std::vector<LogEntry> entries_;
  std::int64_t damaged_bytes_ = 0;
};

}  // namespace barehand
