#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "io/atomic_file.h"
#include "io/lcm/message_sink.h"

namespace lcm {
class LogFile;
}

namespace barehand {

/// Size of an event in a log without its channel and its message [bytes].
inline constexpr std::int64_t kEventHeader = 28;

/// Writes an LCM log, which gets its name when it is finished (AtomicFile); the destructor finishes a log that has
/// events and removes one that has none. Every event is handed to the operating system before `send` returns, so a
/// crash of the program loses nothing. If a write fails (disk full), the file is cut back to the last complete event
/// and stays readable, and later events may succeed. If the reader of a named pipe has gone, events are lost until
/// there is another one.
class LcmLogWriter : public MessageSink {
 public:
  /// An existing file is replaced only if `overwrite`; otherwise it is an error.
  static Result<std::unique_ptr<LcmLogWriter>> create(const std::string& path, bool overwrite);
  ~LcmLogWriter() override;
  LcmLogWriter(const LcmLogWriter&) = delete;
  LcmLogWriter& operator=(const LcmLogWriter&) = delete;

  /// Appends one event with `utime` as its time stamp. If the incomplete event of a failed write
  /// could not be cut off, every later call fails, too.
  Result<void> send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) override;
  /// Closes the log and gives it its name, even if it has no events. Nothing can be sent afterwards.
  Result<void> finish() override;

  /// The path as given; after finish() failed, that of the draft, where the events are.
  const std::string& path() const { return path_; }
  std::int64_t events() const { return events_; }
  std::int64_t bytes() const { return good_; }
  /// Whether the last event failed because the disk was full; there may be room again.
  bool disk_full() const { return disk_full_; }
  /// Whether the incomplete event of a failed write could not be cut off, so that nothing more is written.
  bool failed() const { return failed_; }

 private:
  LcmLogWriter(std::string path, AtomicFile file, std::unique_ptr<lcm::LogFile> log);
  void start_write_back();
  tl::unexpected<Error> cut_back(int reason);

  std::string path_;
  AtomicFile file_;
  std::unique_ptr<lcm::LogFile> log_;  ///< the open log; null when it is finished
  std::int64_t events_ = 0;
  std::int64_t good_ = 0;          ///< size of the file up to the last complete event
  std::int64_t written_back_ = 0;  ///< position in the file up to which writing to the disk has been started
  bool failed_ = false, disk_full_ = false;
};

}  // namespace barehand
