#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand::mcap {

struct Channel {
  std::string topic, encoding;        ///< "/camera/depth"; "cdr"
  std::string type, schema_encoding;  ///< "sensor_msgs/msg/Image"; "ros2msg"
  std::map<std::string, std::string> metadata;
};

/// Where a message is. Its channel is known when it is found.
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;  ///< [ns]
  std::int64_t chunk = -1;     ///< position of its chunk in the file; -1: in none
  std::uint64_t offset = 0;    ///< of its bytes in the unpacked chunk, else in the file
  std::uint64_t size = 0;
};

/// Whether a file begins as MCAP does, whatever its name is.
bool is_mcap(const std::string& path);

/// Reads the messages of an MCAP file, with or without an index, finished or not. Believes nothing that the file says
/// of its own lengths; what is damaged, cut off or packed in an unknown way is left out, and said.
class McapReader {
 public:
  /// Called for every whole message, in the order of the file, with its bytes.
  using Look = std::function<void(const Message&, const Channel&, std::span<const std::uint8_t>)>;

  /// Goes through the file once. Errors: it cannot be opened, or is no MCAP file.
  static Result<McapReader> open(const std::string& path, const Look& look);

  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  /// What was left out, in sentences.
  const std::vector<std::string>& doubts() const { return doubts_; }

  /// The bytes of a message, until the next call. It can only fail when the file changes or the disk breaks.
  Result<std::span<const std::uint8_t>> read(const Message& message);

 private:
  using Bytes = std::vector<std::uint8_t>;
  struct Schema {
    std::string name, encoding;
  };
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  explicit McapReader(std::string path) : path_(std::move(path)) {}
  Result<void> open_file();
  void scan(const Look& look);
  bool read_at(std::uint64_t at, std::uint64_t size, Bytes& out);
  bool take_record(std::uint8_t kind, std::uint64_t at, std::uint64_t size, const Look& look);
  void take_schema(std::span<const std::uint8_t> record);
  void take_channel(std::span<const std::uint8_t> record);
  void take_chunk(std::uint64_t at, const Look& look);
  void take_message(std::span<const std::uint8_t> record, std::int64_t chunk, std::uint64_t at, const Look& look);
  Result<void> unpack(std::uint64_t at, std::uint64_t size);
  std::optional<std::uint64_t> next_chunk(std::uint64_t from);
  void doubt(std::string what);

  std::string path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t size_ = 0;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::map<std::string, std::int64_t> left_out_;  // chunks, by the reason
  std::vector<std::string> doubts_;
  Bytes record_, chunk_;                               // the last ones read
  std::int64_t chunk_at_ = -1;                         // of `chunk_`
  std::map<std::int64_t, std::uint64_t> chunk_sizes_;  // by position, of the records
};

}  // namespace barehand::mcap
