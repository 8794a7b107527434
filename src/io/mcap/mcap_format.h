#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace barehand::mcap {

// The elements of an MCAP file (https://mcap.dev/spec, version 0). A record consists of its kind (1 byte), the length
// of its content (8 bytes) and the content. Numbers are little endian.

inline constexpr std::string_view kMagic = "\x89MCAP0\r\n";
inline constexpr std::int64_t kRecordHeader = 9;

enum class Kind : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 11,
  summary_offset = 14,
  data_end = 15,
};

/// Appends records to `out`, which must outlive the writer. A record is written by begin(), put...() for its fields,
/// and end().
class RecordWriter {
 public:
  static_assert(std::endian::native == std::endian::little);
  explicit RecordWriter(std::vector<std::uint8_t>& out) : out_(out) {}

  void begin(Kind kind) {
    put(kind);
    put<std::uint64_t>(0);  // the length, filled in by end()
    start_ = out_.size();
  }
  void end() {
    const std::uint64_t length = out_.size() - start_;
    std::memcpy(out_.data() + start_ - sizeof length, &length, sizeof length);
  }

  template <class T>
  void put(T value) {
    out_.resize(out_.size() + sizeof value);
    std::memcpy(out_.data() + out_.size() - sizeof value, &value, sizeof value);
  }
  void put_bytes(std::span<const std::uint8_t> bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }
  void put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    out_.insert(out_.end(), text.begin(), text.end());
  }
  void put_map(const std::map<std::string, std::string>& values) {
    std::uint32_t size = 0;
    for (const auto& [key, value] : values) size += static_cast<std::uint32_t>(8 + key.size() + value.size());
    put(size);
    for (const auto& [key, value] : values) put_text(key), put_text(value);
  }
  template <class Key>
  void put_map(const std::map<Key, std::uint64_t>& values) {
    put(static_cast<std::uint32_t>(values.size() * (sizeof(Key) + 8)));
    for (const auto& [key, value] : values) put(key), put(value);
  }

 private:
  std::vector<std::uint8_t>& out_;
  std::size_t start_ = 0;
};

/// Reads the fields of a record from its content. If the content is too short, the missing fields are zero and failed()
/// is true.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  template <class T>
  T get() {
    T value{};
    if (const auto bytes = get_bytes(sizeof value); !bytes.empty()) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  std::span<const std::uint8_t> get_bytes(std::uint64_t count) {
    if (failed_ || count > rest_.size()) {
      failed_ = true;
      return {};
    }
    const auto bytes = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(bytes.size());
    return bytes;
  }
  std::string get_text() {
    const auto bytes = get_bytes(get<std::uint32_t>());
    return {bytes.begin(), bytes.end()};
  }
  std::map<std::string, std::string> get_map() {
    FieldReader inner(get_bytes(get<std::uint32_t>()));
    std::map<std::string, std::string> values;
    while (!inner.rest_.empty() && !inner.failed_) {
      std::string key = inner.get_text();
      values[std::move(key)] = inner.get_text();
    }
    failed_ |= inner.failed_;
    return values;
  }
  std::span<const std::uint8_t> rest() const { return rest_; }
  bool failed() const { return failed_; }

 private:
  std::span<const std::uint8_t> rest_;
  bool failed_ = false;
};

}  // namespace barehand::mcap
