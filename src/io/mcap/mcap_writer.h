#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"

namespace barehand::mcap {

// A writer of MCAP files.

/// Whether an output of this name is to be an MCAP file: it ends in .mcap. An input is known by its content.
inline bool is_mcap_name(const std::filesystem::path& path) { return path.extension() == ".mcap"; }

/// A message to be written, with its topic, type and schema.
struct NewMessage {
  std::string topic, type, schema;  ///< such as "/camera/depth", "sensor_msgs/msg/Image" and a text in ros2msg
  std::map<std::string, std::string> metadata;
  std::vector<std::uint8_t> bytes;  ///< the message, encoded in CDR
};

/// Writes an MCAP file of ROS 2 messages, indexed and in chunks compressed with zstd. The file gets its name when it is
/// finished (AtomicFile); the destructor finishes a file with messages and removes one without. A chunk is handed to
/// the operating system when it has a megabyte or lasts a second, so a crash loses only the messages after the last
/// chunk. If a write fails (disk full), the file is truncated to its last complete chunk, and later messages may
/// succeed. The same messages give the same bytes.
class McapWriter {
 public:
  /// Creates the file. Errors: it exists and `overwrite` is false, or it cannot be created.
  static Result<std::unique_ptr<McapWriter>> create(const std::string& path, bool overwrite);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Appends messages with the same time stamp [ns since the epoch]. On an error, none of them is written. `sequence`:
  /// number of the frame.
  Result<void> write(std::span<const NewMessage> messages, std::uint64_t time, std::uint32_t sequence);
  /// Writes the remaining messages and the index, and gives the file its name. Nothing can be written afterwards.
  Result<void> finish();
  /// The path as given; after the file could not get its name, that of the draft, where the messages are.
  const std::string& path() const { return path_; }

 private:
  using Bytes = std::vector<std::uint8_t>;

  /// An entry of a message index.
  struct Stamp {
    std::uint64_t time = 0, offset = 0;  ///< time of the message [ns], and its position in the chunk
  };
  struct Channel {
    Bytes record;
    std::uint64_t messages = 0;
  };
  struct Span {
    std::uint64_t first = 0, last = 0;  ///< times of the first and the last message [ns]
  };
  using Index = std::map<std::uint16_t, std::vector<Stamp>>;  ///< entries of each channel, keyed by its id

  McapWriter(std::string path, AtomicFile file, int descriptor);
  std::uint16_t schema_of(const NewMessage& message);
  std::uint16_t channel_of(const NewMessage& message);
  void take_back(std::size_t size);
  static Span span_of(const Index& index);
  Bytes chunk_record(Span span) const;
  Result<void> write_chunk();
  Bytes ending() const;
  Bytes statistics() const;
  Result<void> append(const Bytes& bytes);
  void start_write_back();

  std::string path_;
  AtomicFile file_;
  int descriptor_;                  // descriptor of the file; -1 when it is finished
  std::uint64_t good_ = 0;          // size of the file up to the last complete chunk
  std::uint32_t crc_ = 0;           // checksum of the first `good_` bytes
  std::uint64_t written_back_ = 0;  // number of bytes whose writing to the disk was started
  bool failed_ = false;             // whether a failed write could not be undone

  Bytes records_;                  // messages of the next chunk
  Index index_;                    // index of the messages in `records_`
  std::uint64_t chunk_start_ = 0;  // time of the first message in `records_` [ns]
  Bytes new_records_;              // schemas and channels that are not in the file yet

  std::vector<Bytes> schemas_, chunk_indexes_;
  std::vector<Channel> channels_;
  std::map<std::string, std::uint16_t> schema_ids_, channel_ids_;
  std::uint64_t messages_ = 0;  // number of messages in the file
  Span span_;                   // times of the first and the last message in the file
};

}  // namespace barehand::mcap
