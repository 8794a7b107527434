// Records frames to LCM logs when a user of the live page asks for it.
#include "io/lcm/log_recorder.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "io/lcm/log_names.h"

namespace barehand {
namespace fs = std::filesystem;

Result<void> LogRecorder::check_folder(const std::string& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return fail("is no folder", folder, "make the folder first");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    return fail("no file can be made in this folder", folder, "check its permissions");
  return {};
}

LogRecorder::LogRecorder(Options options, std::shared_ptr<spdlog::logger> log, const Clock& clock)
    : options_(std::move(options)), log_(std::move(log)), clock_(clock) {
  state_.folder = options_.folder;
}

Result<void> LogRecorder::start(int user) {
  const std::lock_guard command(command_mutex_);
  if (recording_) return {};
  if (thread_.joinable()) thread_.join();  // the thread of the previous recording

  // Open a new log, and show the reason if that fails.
  auto log = open_new();
  if (!log) {
    const std::string note = "Nothing is recorded: " + log.error().message();
    log_->error(note);
    const std::lock_guard lock(mutex_);
    state_.note = note;
    state_.failed = true;
    return tl::unexpected(log.error());
  }
  log_->info("recording to {}/{}, started from the live page", options_.folder, state().file);

  // Start the thread that writes, with a queue that drops the oldest messages if the disk is too slow.
  const std::lock_guard lock(mutex_);
  queue_ = std::make_unique<Queue>("record", options_.capacity, Overflow::drop_oldest);
  started_us_ = clock_.steady_us();
  user_ = user;
  try {
    thread_ = std::thread([this, log = std::move(*log)] { run(*log); });
  } catch (const std::system_error& e) {
    state_.note = std::string("Nothing is recorded: ") + e.what();
    state_.failed = true;
    return fail(std::string("no thread can be started: ") + e.what(), options_.folder, "try again later");
  }
  recording_ = state_.recording = state_.writing = true;
  return {};
}

/// Creates a log with an unused name in the folder, and stores the name in the state.
Result<std::unique_ptr<LcmLogWriter>> LogRecorder::open_new() {
  const std::string stem = "barehand-" + utc_stamp(clock_.utime());
  std::string name = stem + ".lcmlog";
  std::error_code ignored;
  for (int number = 2; fs::exists(fs::path(options_.folder) / name, ignored); ++number)
    name = stem + "-" + std::to_string(number) + ".lcmlog";
  auto log = LcmLogWriter::create((fs::path(options_.folder) / name).string(), false);
  if (!log) return log;

  const std::lock_guard lock(mutex_);
  state_ = {};
  state_.folder = options_.folder;
  state_.file = name;
  return log;
}

void LogRecorder::stop(int user) {
  const std::lock_guard command(command_mutex_);
  if (!recording_) return;
  end(user == user_ ? "" : "Stopped from another page.", false);
}

void LogRecorder::finish() {
  const std::lock_guard command(command_mutex_);
  end("", false);
  if (thread_.joinable()) thread_.join();
}

/// Stops accepting entries; the waiting ones are still written. `note` and `failed` are stored in the state.
void LogRecorder::end(const std::string& note, bool failed) {
  const std::lock_guard lock(mutex_);
  if (failed || state_.recording) {
    state_.note = note;
    state_.failed = failed;
  }
  if (!state_.recording) return;
  recording_ = state_.recording = false;
  state_.seconds = 1e-6 * static_cast<double>(clock_.steady_us() - started_us_);
  queue_->close();
}

void LogRecorder::post(std::int64_t utime, Write write) {
  const std::lock_guard lock(mutex_);
  if (state_.recording) queue_->push({utime, std::move(write)});
}

RecorderState LogRecorder::state() const {
  const std::lock_guard lock(mutex_);
  RecorderState state = state_;
  if (queue_) state.dropped = queue_->health().dropped;
  if (state.recording) state.seconds = 1e-6 * static_cast<double>(clock_.steady_us() - started_us_);
  return state;
}

void LogRecorder::run(LcmLogWriter& log) {
  Result<void> written;
  try {
    written = write_entries(log);
  } catch (const std::exception& e) {  // most likely out of memory
    written = fail(e.what(), log.path());
  }
  if (!written) end("The recording ended: " + written.error().message(), true);

  // Finish the log, which gives it its name. A log without entries is removed instead (by its destructor).
  if (const auto finished = log.events() > 0 ? log.finish() : Result<void>(); !finished && written) {
    written = finished;
    end("The recording could not be finished: " + finished.error().message(), true);
  }

  const RecorderState done = close(written && log.events() == 0);
  log_->info("recorded {} frames to {}, {:.1f} s, {} dropped", done.frames, log.path(), done.seconds, done.dropped);
  if (done.failed)
    log_->error("{}; tracking goes on", done.note);
  else if (!done.note.empty())
    log_->info(done.note);
}

/// Notes in the state that nothing more is written. `empty`: no entry was written, so there is no file.
RecorderState LogRecorder::close(bool empty) {
  const std::lock_guard lock(mutex_);
  if (empty) {
    state_.file.clear();
    state_.note = "No frame came, so nothing is written.";
  }
  state_.writing = false;
  state_.dropped = queue_->health().dropped;
  return state_;
}

Result<void> LogRecorder::write_entries(LcmLogWriter& log) {
  std::int64_t newest = 0;
  while (auto entry = queue_->pop()) {
    std::error_code ignored;
    if (!fs::is_directory(options_.folder, ignored))
      return fail("the folder is gone", options_.folder, "make it again, then start a new recording");
    if (auto written = entry->write(log); !written) return written;

    const std::lock_guard lock(mutex_);
    if (entry->utime > newest) ++state_.frames;
    newest = std::max(newest, entry->utime);
    state_.bytes = log.bytes();
  }
  return {};
}

}  // namespace barehand
