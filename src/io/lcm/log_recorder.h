#pragma once

#include <spdlog/logger.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "core/clock.h"
#include "core/queue.h"
#include "io/lcm/lcm_log_writer.h"

namespace barehand {

/// What a LogRecorder does, or did last.
struct RecorderState {
  std::string folder;       ///< where recordings go; "": there is none, so nothing can be recorded
  bool recording = false;   ///< further frames are taken
  bool writing = false;     ///< the file is not whole yet
  std::string file;         ///< name, in the folder, of the recording that is written or was written last; "": none yet
  std::int64_t frames = 0;  ///< written
  std::int64_t bytes = 0;   ///< written
  double seconds = 0;       ///< since it was started, until it was stopped
  std::int64_t dropped = 0;  ///< entries that came faster than they could be written
  std::string note;          ///< a sentence about an end that the user did not bring about himself; "": there is none
  bool failed = false;       ///< the note says what went wrong
};

/// Records into LCM logs when a user who looks on says so. Every recording is a new file of the folder,
/// barehand-20261122T090000Z.lcmlog, which never replaces another one. A thread of its own encodes and writes: whoever
/// posts never waits, and entries that come faster are dropped and counted. A disk that is full or gone ends the
/// recording; what was written until then stays. All methods may be called from any thread.
class LogRecorder {
 public:
  /// Encodes and writes one entry; called on the recorder's thread.
  using Write = std::function<Result<void>(MessageSink& log)>;
  struct Options {
    std::string folder;
    std::size_t capacity = 30;  ///< entries that may wait, each with a frame in memory
  };

  /// Errors: `folder` is no folder that can be written to.
  static Result<void> check_folder(const std::string& folder);
  /// `clock` outlives it.
  LogRecorder(Options options, std::shared_ptr<spdlog::logger> log, const Clock& clock);
  ~LogRecorder() { finish(); }
  LogRecorder(const LogRecorder&) = delete;
  LogRecorder& operator=(const LogRecorder&) = delete;

  /// `user`: who says so. Where a recording is under way, it goes on. Errors: no file can be made; the state says so,
  /// too.
  Result<void> start(int user);
  /// What waits is still written. Where nothing is recorded, nothing happens.
  void stop(int user);
  /// Ends a recording that is under way, and waits until the last one is whole.
  void finish();

  bool recording() const { return recording_; }
  /// Nothing happens unless a recording is under way. `utime`: of the frame that this belongs to; a later one than
  /// before counts as a frame.
  void post(std::int64_t utime, Write write);
  RecorderState state() const;

 private:
  struct Entry {
    std::int64_t utime;
    Write write;
  };
  using Queue = BoundedQueue<Entry>;

  Result<std::unique_ptr<LcmLogWriter>> open_new();
  void run(LcmLogWriter& log);
  Result<void> write_entries(LcmLogWriter& log);
  void end(const std::string& note, bool failed);
  RecorderState close(bool empty);

  const Options options_;
  const std::shared_ptr<spdlog::logger> log_;
  const Clock& clock_;
  std::atomic<bool> recording_ = false;

  std::mutex command_mutex_;  // one start or stop at a time; protects the next member. Held while a file is made
  std::thread thread_;

  mutable std::mutex mutex_;      // protects the members below; never held while anything is written, also to the log
  std::unique_ptr<Queue> queue_;  // of the last recording; closed: it takes nothing more
  RecorderState state_;
  std::int64_t started_us_ = 0;  // steady clock
  int user_ = 0;                 // who started it
};

}  // namespace barehand
