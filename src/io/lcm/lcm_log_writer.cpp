// Writes an LCM log that stays readable if the disk is full or the program crashes.
#include "io/lcm/lcm_log_writer.h"

#include <fcntl.h>
#include <stdio_ext.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <lcm/lcm-cpp.hpp>

#include "io/pipe_room.h"

namespace barehand {

LcmLogWriter::LcmLogWriter(std::string path, AtomicFile file, std::unique_ptr<lcm::LogFile> log)
    : path_(std::move(path)), file_(std::move(file)), log_(std::move(log)) {}

LcmLogWriter::~LcmLogWriter() {
  if (events_ > 0) (void)finish();
}

namespace {

/// Opens a log that writes to the descriptor of `whole`: LCM opens logs only by name, so the descriptor is exchanged
/// afterwards. Returns null with errno set if it fails.
std::unique_ptr<lcm::LogFile> open_log(const AtomicFile& whole) {
  const int file = whole.open();
  if (file < 0) return nullptr;
  auto log = std::make_unique<lcm::LogFile>("/dev/null", "w");
  const bool led = log->good() && dup3(file, fileno(log->getFilePtr()), O_CLOEXEC) >= 0;
  close(file);
  return led ? std::move(log) : nullptr;
}

}  // namespace

Result<std::unique_ptr<LcmLogWriter>> LcmLogWriter::create(const std::string& path, bool overwrite) {
  auto file = AtomicFile::create(path, overwrite);
  if (!file) return tl::unexpected(file.error());
  errno = 0;
  auto log = open_log(*file);
  if (!log)
    return fail(std::string("cannot create the log: ") + std::strerror(errno), path,
                "check the folder and its permissions");
  return std::unique_ptr<LcmLogWriter>(new LcmLogWriter(path, std::move(*file), std::move(log)));
}

Result<void> LcmLogWriter::finish() {
  if (!log_) return {};
  log_.reset();
  const std::string draft = file_.draft();
  auto finished = file_.finish();
  if (!finished) path_ = draft;
  return finished;
}

Result<void> LcmLogWriter::send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) {
  // Refuse what cannot be written.
  if (!log_) return fail("the log is finished, nothing more is written", path_);
  if (failed_) return fail("an earlier write failed and could not be undone, nothing more is written", path_);
  if (channel.empty() || channel.size() > kLongestChannel)
    return fail("channel names have 1 to 63 bytes, \"" + channel + "\" has " + std::to_string(channel.size()), path_);
  if (!has_room(fileno(log_->getFilePtr()), kEventHeader + channel.size() + message.size()))
    return fail("the reader of this pipe is behind", path_, "events are left out until it has read more");

  // Write the event through LCM's own class; an incomplete one is removed again.
  lcm::LogEvent event;
  event.eventnum = 0;  // LogFile sets the event's number
  event.timestamp = utime;
  event.channel = channel;
  event.datalen = static_cast<std::int32_t>(message.size());
  event.data = const_cast<std::uint8_t*>(message.data());
  errno = 0;
  if (log_->writeEvent(&event) != 0 || std::fflush(log_->getFilePtr()) != 0) return cut_back(errno);

  // Count what is now safely in the log.
  disk_full_ = false;
  good_ += kEventHeader + static_cast<std::int64_t>(channel.size() + message.size());
  ++events_;
  start_write_back();
  return {};
}

/// From time to time, tells the operating system to write to the disk, so that finishing a large log need not wait for
/// all of it.
void LcmLogWriter::start_write_back() {
  constexpr std::int64_t kPiece = 8 << 20;
  if (good_ - written_back_ < kPiece) return;
  (void)sync_file_range(fileno(log_->getFilePtr()), written_back_, good_ - written_back_, SYNC_FILE_RANGE_WRITE);
  written_back_ = good_;
}

tl::unexpected<Error> LcmLogWriter::cut_back(int reason) {
  std::FILE* file = log_->getFilePtr();
  __fpurge(file);  // otherwise closing the file would append the rest of the failed event
  std::clearerr(file);
  if (reason == EPIPE) return fail("no program reads this pipe", path_, "the log continues when one does");
  const bool cut = !file_.direct() && ftruncate(fileno(file), good_) == 0 && fseeko(file, good_, SEEK_SET) == 0;
  failed_ = !cut;
  disk_full_ = cut && (reason == ENOSPC || reason == EDQUOT);
  return fail(std::string("cannot write the log: ") + std::strerror(reason), path_,
              cut ? "the " + std::to_string(events_) + " events before are kept; free some space"
                  : "the log ends in an incomplete event, which readers skip");
}

}  // namespace barehand
