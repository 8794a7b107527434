// Reads the events of an LCM log, even if it is truncated or damaged.
#include "io/lcm/lcm_log_reader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>

#include "io/atomic_file.h"
#include "io/lcm/lcm_log_writer.h"

namespace barehand {
namespace {

// An event has a sync word, event number, time stamp, length of the channel and length of the message (4, 8, 8, 4, 4
// bytes, big endian), then the channel and the message (LCM's log file format).
constexpr std::array<std::uint8_t, 4> kSync = {0xED, 0xA1, 0xDA, 0x01};

std::int64_t big_endian(const std::uint8_t* bytes, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[i];
  return static_cast<std::int64_t>(value);
}

/// Finds the complete events of a log.
class Scanner {
 public:
  Scanner(std::FILE* file, std::int64_t size) : file_(file), size_(size) {}

  /// Fills `entries` and returns the number of bytes that belong to none of them.
  std::int64_t scan(std::vector<LogEntry>& entries) {
    std::int64_t damaged = 0;

    // Go from event to event, or from damage to the next event.
    for (std::int64_t at = 0; at < size_;) {
      auto entry = event_at(at);
      std::int64_t next = entry ? end_of(*entry) : next_sync(at + 1);
      if (entry && !may_follow(next)) {  // the event may be cut short, so that its stated length covers later events
        if (const auto within = whole_event(at + 1, next)) {
          entry.reset();
          next = *within;
        }
      }

      // Keep the event, or count the bytes that belong to none.
      if (entry)
        entries.push_back(std::move(*entry));
      else
        damaged += next - at;
      at = next;
    }
    return damaged;
  }

 private:
  bool read(std::int64_t at, void* bytes, std::size_t count) {
    return fseeko(file_, at, SEEK_SET) == 0 && std::fread(bytes, 1, count, file_) == count;
  }
  static std::int64_t end_of(const LogEntry& entry) {
    return entry.position + kEventHeader + static_cast<std::int64_t>(entry.channel.size()) + entry.size;
  }
  /// Whether the file ends at `at` or continues with a sync word, of which the end may be missing.
  bool may_follow(std::int64_t at) {
    std::array<std::uint8_t, kSync.size()> word{};
    const auto count = static_cast<std::size_t>(std::min<std::int64_t>(word.size(), size_ - at));
    return read(at, word.data(), count) && std::equal(word.begin(), word.begin() + count, kSync.begin());
  }
  /// Position of the first event in [from, to) at whose end may_follow() is true.
  std::optional<std::int64_t> whole_event(std::int64_t from, std::int64_t to) {
    for (std::int64_t at = next_sync(from); at < to; at = next_sync(at + 1))
      if (const auto entry = event_at(at); entry && may_follow(end_of(*entry))) return at;
    return std::nullopt;
  }

  std::optional<LogEntry> event_at(std::int64_t at) {
    // Read the header, which begins with the sync word.
    std::array<std::uint8_t, kEventHeader> header{};
    if (size_ - at < kEventHeader || !read(at, header.data(), header.size())) return std::nullopt;
    if (!std::equal(kSync.begin(), kSync.end(), header.begin())) return std::nullopt;

    // Take the time and the sizes from the header.
    const auto channel_size = static_cast<std::size_t>(big_endian(&header[20], 4));
    LogEntry entry;
    entry.position = at;
    entry.timestamp = big_endian(&header[12], 8);
    entry.size = static_cast<std::int32_t>(big_endian(&header[24], 4));

    // Reject sizes that are implausible or exceed the file.
    if (channel_size < 1 || channel_size > kLongestChannel || entry.size < 0) return std::nullopt;
    if (size_ - at < kEventHeader + static_cast<std::int64_t>(channel_size) + entry.size) return std::nullopt;

    // Read the name of the channel and the beginning of the message.
    entry.channel.resize(channel_size);
    if (!read(at + kEventHeader, entry.channel.data(), entry.channel.size())) return std::nullopt;
    std::array<std::uint8_t, LogEntry::kStart> start{};
    const auto known = std::min<std::size_t>(start.size(), static_cast<std::size_t>(entry.size));
    if (std::fread(start.data(), 1, known, file_) != known) return std::nullopt;
    entry.read_start(std::span(start).first(known));
    return entry;
  }

  /// Position of the next sync word at or after `at`, or the end of the file.
  std::int64_t next_sync(std::int64_t at) {
    std::array<std::uint8_t, 1 << 16> block;
    for (; at < size_; at += block.size() - (kSync.size() - 1)) {
      const auto count = static_cast<std::size_t>(std::min<std::int64_t>(block.size(), size_ - at));
      if (!read(at, block.data(), count)) break;
      const auto end = block.begin() + count;
      const auto found = std::search(block.begin(), end, kSync.begin(), kSync.end());
      if (found != end) return at + (found - block.begin());
    }
    return size_;
  }

  std::FILE* file_;
  std::int64_t size_;
};

}  // namespace

void LogEntry::read_start(std::span<const std::uint8_t> message) {
  if (message.size() >= 8) hash = big_endian(&message[0], 8);
  if (message.size() >= 16) utime = big_endian(&message[8], 8);
  if (message.size() >= 24) third = big_endian(&message[16], 8);
}

Result<LcmLogReader> LcmLogReader::open(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return fail("is a folder, not an LCM log", path);
  if (std::filesystem::is_other(path, error))
    return fail("is a pipe or a device, not an LCM log", path, "write it into a file first");
  LcmLogReader reader(path);
  if (const auto opened = reader.open_file(); !opened) return tl::unexpected(opened.error());
  const auto size = std::filesystem::file_size(path, error);
  if (error) return fail("cannot determine the size of the log: " + error.message(), path);
  if (size == 0) return fail("the log is empty", path);
  reader.damaged_bytes_ = Scanner(reader.file_.get(), static_cast<std::int64_t>(size)).scan(reader.entries_);
  return reader;
}

Result<void> LcmLogReader::open_file() {
  file_.reset(std::fopen(path_.c_str(), "rb"));

  // If it was a draft, a recorder that continues its set may have given it its name.
  if (const std::string name = finished_name(path_); !file_ && errno == ENOENT && !name.empty())
    file_.reset(std::fopen(name.c_str(), "rb"));
  if (!file_) return fail(std::string("cannot open the log: ") + std::strerror(errno), path_);
  return {};
}

Result<std::vector<std::uint8_t>> LcmLogReader::read(const LogEntry& entry) {
  if (!file_)
    if (const auto opened = open_file(); !opened) return tl::unexpected(opened.error());
  std::vector<std::uint8_t> message(static_cast<std::size_t>(entry.size));
  const std::int64_t at = entry.position + kEventHeader + static_cast<std::int64_t>(entry.channel.size());
  const bool whole = fseeko(file_.get(), at, SEEK_SET) == 0 &&
                     std::fread(message.data(), 1, message.size(), file_.get()) == message.size();
  if (!whole) return fail("the log changed while it was read", path_);
  return message;
}

}  // namespace barehand
