#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// One whole event of an LCM log.
struct LogEntry {
  std::int64_t position = 0;   ///< byte offset of its header in the file
  std::int64_t timestamp = 0;  ///< the log's own stamp: when the event was received [us]
  std::string channel;
  std::int32_t size = 0;   ///< of the message [bytes]
  std::int64_t hash = 0;   ///< the message's type fingerprint; 0 if it is shorter than 8 bytes
  std::int64_t utime = 0;  ///< the message's second 64-bit word, the time of the measurement in every type read here
  std::int64_t third = 0;  ///< its third one, `seq` in rgbd_frame_t
};

/// Random access to an LCM log. Believes nothing that the file says about its own lengths, and survives damage:
/// liblcm's reader loses the event before a damaged one and allocates whatever a damaged length claims.
class LcmLogReader {
 public:
  /// Finds every whole event in one pass over the headers, without reading the messages. There may be none. Errors: a
  /// file that cannot be opened or is empty.
  static Result<LcmLogReader> open(const std::string& path);

  const std::vector<LogEntry>& entries() const { return entries_; }  ///< in file order
  /// Bytes that belong to no whole event: a cut tail, damage in the middle. 0 for a healthy log.
  std::int64_t damaged_bytes() const { return damaged_bytes_; }

  /// The message of an event. It can only fail when the file changes or the disk breaks.
  Result<std::vector<std::uint8_t>> read(const LogEntry& entry);
  /// Lets go of the file until the next read(): thousands of logs are more than may be open at once.
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
