#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "io/message_sink.h"

namespace lcm {
class LogFile;
}

namespace barehand {

/// What an event of a log takes besides its channel and its message [bytes].
inline constexpr std::int64_t kEventHeader = 28;

/// Writes an LCM log. Every event is handed to the operating system before `send` returns, so a crash of the program
/// loses nothing; when a write fails (disk full) the file is cut back to the last whole event, stays readable, and
/// later events may succeed.
class LcmLogWriter : public MessageSink {
 public:
  /// An existing file is replaced only if `overwrite`; otherwise it is an error.
  static Result<std::unique_ptr<LcmLogWriter>> create(const std::string& path, bool overwrite);
  ~LcmLogWriter() override;

  /// Appends one event with `utime` as its stamp. Where a failed write could not be cut off, every later call fails
  /// too.
  Result<void> send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) override;

  std::int64_t events() const { return events_; }
  std::int64_t bytes() const { return good_; }
  /// The last event failed for want of room, and there may be room again.
  bool disk_full() const { return disk_full_; }
  /// A failed write could not be cut off: nothing more is written.
  bool failed() const { return failed_; }

 private:
  LcmLogWriter(std::string path, std::unique_ptr<lcm::LogFile> log);
  tl::unexpected<Error> cut_back(int reason);

  std::string path_;
  std::unique_ptr<lcm::LogFile> log_;
  std::int64_t events_ = 0;
  std::int64_t good_ = 0;  ///< size of the file up to the last whole event
  bool failed_ = false, disk_full_ = false;
};

}  // namespace barehand
