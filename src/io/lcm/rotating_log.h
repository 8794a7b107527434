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

/// When a recording goes on in a new file, and how much of it is kept. 0: no limit.
struct LogRotation {
  std::int64_t max_bytes = 0;   ///< of one file
  std::int64_t max_age_us = 0;  ///< of one file
  std::int64_t quota = 0;       ///< of all files together [bytes]
};

/// Whether `file` is, by its name and folder, one of the logs of the set "take.lcmlog".
bool belongs_to_set(const std::filesystem::path& file, const std::filesystem::path& set);

/// Whoever writes the set of logs `path` has its lock, .take.lcmlog.lock in the folder, which is made: two at once
/// would remove each other's files. Waits for up to `patience` for one who is about to end. Readers need none.
Result<FileLock> lock_set(const std::string& path, std::chrono::milliseconds patience);

/// A recording that never ends: a set of LCM logs, each complete in itself. "take.lcmlog" becomes
/// take-000001-20261122T090000Z.lcmlog and so on, counted on from the files that are there. A file has its name when it
/// is closed (WholeFile); one that a killed program left gets it when the set goes on. When the quota is used up, and
/// when the disk is full, the oldest files of the set are removed, never the one that is written. Without a quota
/// nothing is removed.
class RotatingLog : public MessageSink {
 public:
  /// Makes the folder; the first file is made for the first event. `clock` outlives it. Errors: the folder cannot be
  /// made, or the quota does not hold two files.
  static Result<std::unique_ptr<RotatingLog>> create(const std::string& path, LogRotation rotation, const Clock& clock);

  /// An event that cannot be written is lost; the next one may succeed, in a new file if need be.
  Result<void> send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) override;
  Result<void> finish() override;

 private:
  struct File {
    std::filesystem::path path;
    std::int64_t number;
    std::int64_t bytes;
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
  std::deque<File> files_;  ///< by number; the last one is written while `log_` is open
  std::unique_ptr<LcmLogWriter> log_;
  std::int64_t opened_us_ = 0;
};

}  // namespace barehand
