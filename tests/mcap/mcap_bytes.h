#pragma once

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "io/mcap/mcap_format.h"

namespace barehand::test {

using Bytes = std::vector<std::uint8_t>;

inline Bytes read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

inline void write_bytes(const std::string& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Cuts off what follows the last chunk of a finished file, as if its recorder had been killed.
inline void cut_off_end(const std::string& path) {
  Bytes bytes = read_bytes(path);
  constexpr std::size_t kFooter = 8 + 8 + 4, kDataEnd = mcap::kRecordHeader + 4;
  std::uint64_t summary = 0;  // the footer begins with its position; the end of the data comes before it
  std::memcpy(&summary, bytes.data() + bytes.size() - mcap::kMagic.size() - kFooter, sizeof summary);
  bytes.resize(summary - kDataEnd);
  write_bytes(path, bytes);
}

/// Composes MCAP files that McapWriter would never write: those of other programs, and files with wrong values.
class ForeignMcap {
 public:
  ForeignMcap() : writer_(bytes_) {
    bytes_.assign(mcap::kMagic.begin(), mcap::kMagic.end());
    writer_.begin(mcap::Kind::header);
    writer_.put_text("");
    writer_.put_text("another program");
    writer_.end();
  }
  /// Adds a channel and its schema, which gets the same number, outside of chunks, as the format allows.
  ForeignMcap& channel(std::uint16_t id, const std::string& topic, const std::string& type,
                       const std::string& encoding = "cdr") {
    writer_.begin(mcap::Kind::schema);
    writer_.put(id);
    writer_.put_text(type);
    writer_.put_text(encoding == "cdr" ? "ros2msg" : encoding);
    writer_.put_text("");
    writer_.end();

    // Write the channel, which names its schema.
    writer_.begin(mcap::Kind::channel);
    writer_.put(id);
    writer_.put(id);
    writer_.put_text(topic);
    writer_.put_text(encoding);
    writer_.put_map(std::map<std::string, std::string>());
    writer_.end();
    return *this;
  }
  ForeignMcap& message(std::uint16_t channel, const Bytes& message) {
    writer_.begin(mcap::Kind::message);
    writer_.put(channel);
    writer_.put<std::uint32_t>(0);
    writer_.put<std::uint64_t>(7);
    writer_.put<std::uint64_t>(7);
    writer_.put_bytes(message);
    writer_.end();
    return *this;
  }
  ForeignMcap& chunk(const std::string& compression, std::uint64_t size, const Bytes& packed) {
    writer_.begin(mcap::Kind::chunk);
    writer_.put<std::uint64_t>(0);
    writer_.put<std::uint64_t>(0);
    writer_.put(size);
    writer_.put<std::uint32_t>(0);
    writer_.put_text(compression);
    writer_.put<std::uint64_t>(packed.size());
    writer_.put_bytes(packed);
    writer_.end();
    return *this;
  }
  /// Writes the file with the records that end it, but without a summary.
  void write(const std::string& path) {
    writer_.begin(mcap::Kind::data_end);
    writer_.put<std::uint32_t>(0);
    writer_.end();
    write_bytes(path, bytes_);
  }

 private:
  Bytes bytes_;
  mcap::RecordWriter writer_;
};

}  // namespace barehand::test
