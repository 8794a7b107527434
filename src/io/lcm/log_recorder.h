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

// The recorder of the live page.

/// The state of a LogRecorder and of its current or last recording.
struct RecorderState {
  std::string folder;        ///< folder of the recordings; "": there is none, so nothing can be recorded
  bool recording = false;    ///< whether new frames are being recorded
  bool writing = false;      ///< whether the file is not complete yet
  std::string file;          ///< name of the current or last recording's file in the folder; "": none yet
  std::int64_t frames = 0;   ///< number of frames written
  std::int64_t bytes = 0;    ///< number of bytes written
  double seconds = 0;        ///< duration of the recording so far, or until it was stopped [s]
  std::int64_t dropped = 0;  ///< number of entries dropped because they arrived faster than they could be written
  std::string note;          ///< why the recording ended, as a sentence; "": the user stopped it, or it has not ended
  bool failed = false;       ///< whether `note` describes an error
};

/// Records frames to LCM logs when a user of the live page asks for it. Every recording is a new file in the folder,
/// such as barehand-20261122T090000Z.lcmlog, which never replaces another one. A separate thread encodes and writes, so
/// post() never waits; if entries arrive faster than they are written, the oldest waiting ones are dropped and counted.
/// A full or missing disk ends the recording; what was written before stays. All functions may be called from any
/// thread.
class LogRecorder {
 public:
  /// Encodes and writes one entry; called on the recorder's thread.
  using Write = std::function<Result<void>(MessageSink& log)>;
  struct Options {
    std::string folder;
    std::size_t capacity = 30;  ///< largest number of waiting entries, each with a frame in memory
  };

  /// Checks that recordings can be written to `folder`. Errors: it is not a folder, or there is no permission.
  static Result<void> check_folder(const std::string& folder);
  /// `clock` must outlive the recorder.
  LogRecorder(Options options, std::shared_ptr<spdlog::logger> log, const Clock& clock);
  ~LogRecorder() { finish(); }
  LogRecorder(const LogRecorder&) = delete;
  LogRecorder& operator=(const LogRecorder&) = delete;

  /// Starts a recording unless one is in progress. `user`: number of the user who asks for it. Error: no file can be
  /// created; the state contains the error, too.
  Result<void> start(int user);
  /// Stops the recording if one is in progress; waiting entries are still written. `user`: as for start().
  void stop(int user);
  /// Stops the recording if one is in progress, and waits until its file is complete.
  void finish();

  bool recording() const { return recording_; }
  /// Queues an entry; does nothing unless a recording is in progress. `utime`: time stamp of the entry's frame [us];
  /// entries whose time stamp is later than all before count as a new frame.
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

  std::mutex command_mutex_;  // serialises start() and stop(), also while a file is created; protects the next member
  std::thread thread_;

  mutable std::mutex mutex_;      // protects the members below; never held while writing to a file or logging
  std::unique_ptr<Queue> queue_;  // entries of the current or last recording; closed when the recording was stopped
  RecorderState state_;
  std::int64_t started_us_ = 0;  // start of the recording, steady clock
  int user_ = 0;                 // number of the user who started the recording
};

}  // namespace barehand
