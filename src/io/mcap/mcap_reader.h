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

// A reader of MCAP files.

/// A channel of the file: a topic and how its messages are encoded.
struct Channel {
  std::string topic, encoding;        ///< such as "/camera/depth" and "cdr"
  std::string type, schema_encoding;  ///< such as "sensor_msgs/msg/Image" and "ros2msg"
  std::map<std::string, std::string> metadata;
};

/// The position of a message in the file.
struct Message {
  std::uint16_t channel = 0;  ///< key of McapReader::channels()
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;  ///< time at which the message was recorded [ns]
  std::int64_t chunk = -1;     ///< position of its chunk in the file; -1: it is not in a chunk
  std::uint64_t offset = 0;    ///< position of its data in the unpacked chunk, or in the file if it is not in a chunk
  std::uint64_t size = 0;
};

/// Whether a file begins like an MCAP file, whatever its name is.
bool is_mcap(const std::string& path);

/// Reads the messages of an MCAP file, with or without an index, finished or not. All lengths in the file are checked;
/// chunks that are damaged, cut off or compressed in an unknown way are left out and reported by warnings().
class McapReader {
 public:
  /// Called for every complete message, in the order of the file, with its data.
  using MessageVisitor = std::function<void(const Message&, const Channel&, std::span<const std::uint8_t>)>;

  /// Reads the whole file once and calls `visit` for its messages. Errors: it cannot be opened, or is not an MCAP file.
  static Result<McapReader> open(const std::string& path, const MessageVisitor& visit);

  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  /// Warnings for the user about chunks and messages that were left out.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Returns the data of a message, valid until the next call. Error: the file has changed or can no longer be read.
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
  void scan(const MessageVisitor& visit);
  bool read_at(std::uint64_t at, std::uint64_t size, Bytes& out);
  bool take_record(std::uint8_t kind, std::uint64_t at, std::uint64_t size, const MessageVisitor& visit);
  void take_schema(std::span<const std::uint8_t> record);
  void take_channel(std::span<const std::uint8_t> record);
  void take_chunk(std::uint64_t at, const MessageVisitor& visit);
  void take_message(std::span<const std::uint8_t> record, std::int64_t chunk, std::uint64_t at,
                    const MessageVisitor& visit);
  Result<void> unpack(std::uint64_t at, std::uint64_t size);
  std::optional<std::uint64_t> next_chunk(std::uint64_t from);
  void warn(std::string what);

  std::string path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t size_ = 0;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::map<std::string, std::int64_t> left_out_;  // number of chunks that were left out, by reason
  std::vector<std::string> warnings_;
  Bytes record_, chunk_;                               // the record read last, and the chunk unpacked last
  std::int64_t chunk_at_ = -1;                         // position of `chunk_` in the file; -1: none
  std::map<std::int64_t, std::uint64_t> chunk_sizes_;  // sizes of the chunk records, by position
};

}  // namespace barehand::mcap
