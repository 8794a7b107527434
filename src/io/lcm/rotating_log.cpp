// Writes an LCM log as a set of files, whose oldest ones are removed.
#include "io/lcm/rotating_log.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "core/format.h"
#include "io/lcm/log_names.h"
#include "io/place.h"

namespace barehand {
namespace fs = std::filesystem;
namespace {

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

bool no_room(const fs::path& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  return !error && space.available < 1 << 16;
}

}  // namespace

bool belongs_to_set(const fs::path& file, const fs::path& set) {
  return number_in_set(file, set) && Place(folder_of(file)) == Place(folder_of(set));
}

Result<FileLock> lock_set(const std::string& path, std::chrono::milliseconds patience) {
  const fs::path folder = folder_of(path);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    return fail("cannot be created: " + error.message(), folder.string(), "check the path and its permissions");
  const std::string name = fs::path(path).filename().string();
  auto lock = FileLock::take((folder / ("." + name + ".lock")).string(), patience);
  if (!lock) lock.error().what = "this set of logs cannot be written, its lock " + lock.error().what;
  return lock;
}

RotatingLog::RotatingLog(fs::path path, LogRotation rotation, const Clock& clock)
    : path_(std::move(path)), rotation_(rotation), clock_(clock) {}

Result<std::unique_ptr<RotatingLog>> RotatingLog::create(const std::string& path, LogRotation rotation,
                                                         const Clock& clock) {
  // Choose a size for the files that suits the quota, or check the one given.
  if (rotation.quota > 0 && rotation.max_bytes == 0) rotation.max_bytes = std::max<std::int64_t>(1, rotation.quota / 8);
  if (rotation.quota > 0 && rotation.quota < 2 * rotation.max_bytes)
    return fail("the quota is smaller than two files of the maximum size", path,
                "increase the quota or make the files smaller");

  // Create the folder of the logs.
  const fs::path folder = folder_of(path);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    return fail("cannot be created: " + error.message(), folder.string(), "check the path and its permissions");

  // Take over what an earlier run left behind.
  std::unique_ptr<RotatingLog> log(new RotatingLog(path, rotation, clock));
  log->finish_abandoned_files();
  log->find_files();
  return log;
}

/// Gives the drafts of earlier runs their names. Must be called before the first file of this run is created, because
/// until then every draft of the set is from an earlier run.
void RotatingLog::finish_abandoned_files() const {
  const std::string ending = path_.extension().string() + std::string(kUnfinished);
  std::error_code ignored;
  std::vector<std::string> drafts;
  for (const auto& entry : fs::directory_iterator(folder_of(path_), ignored)) {
    const std::string name = entry.path().filename().string();
    const bool draft = name.ends_with(ending) && entry.file_size(ignored) > 0;
    if (draft && number_in_set(name.substr(0, name.size() - kUnfinished.size()), path_)) drafts.push_back(entry.path());
  }
  for (const std::string& draft : drafts) finish_abandoned(draft, draft.substr(0, draft.size() - kUnfinished.size()));
}

void RotatingLog::find_files() {
  std::error_code ignored;  // an unreadable folder is reported when a file is created
  for (const auto& entry : fs::directory_iterator(folder_of(path_), ignored))
    if (const auto number = number_in_set(entry.path(), path_))
      files_.push_back({entry.path(), *number, static_cast<std::int64_t>(entry.file_size(ignored))});
  std::sort(files_.begin(), files_.end(), [](const File& a, const File& b) { return a.number < b.number; });
}

Result<void> RotatingLog::send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) {
  // Make room for the message: close a full file, and remove the oldest files beyond the quota.
  const auto bytes = kEventHeader + static_cast<std::int64_t>(channel.size() + message.size());
  if (log_ && is_full(bytes))
    if (const auto closed = close(); !closed) return closed;
  while (rotation_.quota > 0 && used() + bytes > rotation_.quota && remove_oldest()) {
  }

  // Open the next file if none is open.
  if (!log_)
    if (const auto opened = open_next(); !opened) return opened;

  // Write the message; on a full disk, old files give way to it.
  auto sent = log_->send(channel, message, utime);
  while (!sent && log_->disk_full() && rotation_.quota > 0 && remove_oldest())
    sent = log_->send(channel, message, utime);

  // Give up a file that can no longer be written, so that the next message opens another.
  files_.back().bytes = log_->bytes();
  files_.back().events = log_->events();
  if (log_->failed()) (void)close();
  return sent;
}

Result<void> RotatingLog::finish() { return log_ ? close() : Result<void>(); }

Result<void> RotatingLog::close() {
  const auto finished = log_->finish();
  log_.reset();
  return finished;
}

bool RotatingLog::is_full(std::int64_t more) const {
  if (log_->events() == 0) return false;
  const bool large = rotation_.max_bytes > 0 && log_->bytes() + more > rotation_.max_bytes;
  return large || (rotation_.max_age_us > 0 && clock_.steady_us() - opened_us_ >= rotation_.max_age_us);
}

Result<void> RotatingLog::open_next() {
  const std::int64_t number = files_.empty() ? 1 : files_.back().number + 1;
  const std::string name = formatted("%s-%06lld-%s", path_.stem().c_str(), static_cast<long long>(number),
                                     utc_stamp(clock_.utime()).c_str());
  const fs::path path = path_.parent_path() / (name + path_.extension().string());
  auto log = LcmLogWriter::create(path.string(), false);
  while (!log && rotation_.quota > 0 && no_room(folder_of(path_)) && remove_oldest())
    log = LcmLogWriter::create(path.string(), false);
  if (!log) return tl::unexpected(log.error());
  log_ = std::move(*log);
  files_.push_back({path, number, 0});
  opened_us_ = clock_.steady_us();
  return {};
}

bool RotatingLog::remove_oldest() {
  if (files_.size() <= (log_ ? 1u : 0u)) return false;
  std::error_code error;
  fs::remove(files_.front().path, error);
  removed_events_ += files_.front().events;
  files_.pop_front();  // forget the file even if it could not be removed, so that this is not tried again
  return true;
}

std::int64_t RotatingLog::used() const {
  return std::accumulate(files_.begin(), files_.end(), std::int64_t{0},
                         [](std::int64_t sum, const File& file) { return sum + file.bytes; });
}

}  // namespace barehand
