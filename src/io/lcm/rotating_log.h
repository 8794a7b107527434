#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>

#include "core/clock.h"
#include "io/file_lock.h"
#include "io/lcm/lcm_log_writer.h"

namespace barehand {

// An LCM log that is written as a set of files, whose oldest ones are removed.

/// Limits at which a recording continues in a new file, and limit of all its files together. 0: no limit.
struct LogRotation {
  std::int64_t max_bytes = 0;   ///< largest size of one file [bytes]
  std::int64_t max_age_us = 0;  ///< longest time in one file [us]
  std::int64_t quota = 0;       ///< largest size of all files together [bytes]
};

/// Whether `file`, by its name and folder, is one of the logs of a set. `set` is the path that the set was recorded
/// under, such as "take.lcmlog".
bool belongs_to_set(const std::filesystem::path& file, const std::filesystem::path& set);

/// Locks the set of logs `path` for writing: two writers at once would remove each other's files. The lock is the file
/// .take.lcmlog.lock in the folder, which is created. Waits for up to `patience` for a writer that is about to end.
/// Readers need no lock.
Result<FileLock> lock_set(const std::string& path, std::chrono::milliseconds patience);

/// An endless recording: a set of LCM logs, each complete in itself. "take.lcmlog" becomes
/// take-000001-20261122T090000Z.lcmlog and so on; the numbers continue those of existing files. A file gets its name
/// when it is closed (AtomicFile); one that a killed program left gets it when the set is continued. When the quota is
/// used up, and when the disk is full, the oldest files of the set are removed, never the one that is being written.
/// Without a quota nothing is removed.
class RotatingLog : public MessageSink {
 public:
  /// Creates the folder; the first file is created for the first event. `clock` must outlive the log. Errors: the
  /// folder cannot be created, or the quota does not hold two files.
  static Result<std::unique_ptr<RotatingLog>> create(const std::string& path, LogRotation rotation, const Clock& clock);

  /// An event that cannot be written is lost; the next one may succeed, in a new file if need be.
  Result<void> send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) override;
  Result<void> finish() override;
  /// Number of the events sent that are gone again, since their files gave way to newer ones.
  std::int64_t removed_events() const { return removed_events_; }

 private:
  struct File {
    std::filesystem::path path;
    std::int64_t number;
    std::int64_t bytes;
    std::int64_t events = 0;  // written by this object
  };
  RotatingLog(std::filesystem::path path, LogRotation rotation, const Clock& clock);
  void finish_abandoned_files() const;
  void find_files();
  Result<void> close();
  bool is_full(std::int64_t more) const;
  Result<void> open_next();
  bool remove_oldest();
  std::int64_t used() const;

  const std::filesystem::path path_;
  const LogRotation rotation_;
  const Clock& clock_;
  std::deque<File> files_;  ///< in the order of their numbers; the last one is being written while `log_` is open
  std::unique_ptr<LcmLogWriter> log_;
  std::int64_t opened_us_ = 0;
  std::int64_t removed_events_ = 0;
};

}  // namespace barehand
