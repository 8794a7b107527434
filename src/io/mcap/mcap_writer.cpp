// Writes an MCAP file with compressed chunks and an index.
#include "io/mcap/mcap_writer.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "io/mcap/mcap_format.h"
#include "io/pipe_room.h"

namespace barehand::mcap {
namespace {

// A chunk is written when it has this size before compression [bytes]; one frame of most cameras is smaller.
constexpr std::size_t kChunkSize = 1 << 20;
constexpr std::string_view kZstd = "zstd";
constexpr std::size_t kChunkFields = 9 + 8 + 8 + 8 + 4 + 4 + 4 + 8;  // size of a chunk record before its messages
constexpr std::uint64_t kChunkTime = 1'000'000'000;  // a chunk is written when it lasts this long [ns], too
constexpr int kLevel = 1;  // compression level of zstd; fast enough for live cameras: milliseconds per frame

std::uint32_t crc_of(std::uint32_t before, const std::vector<std::uint8_t>& bytes) {
  return static_cast<std::uint32_t>(crc32_z(before, bytes.data(), bytes.size()));
}

std::vector<std::uint8_t> compressed(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::uint8_t> out(ZSTD_compressBound(bytes.size()));
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kLevel));
  return out;
}

}  // namespace

McapWriter::McapWriter(std::string path, AtomicFile file, int descriptor)
    : path_(std::move(path)), file_(std::move(file)), descriptor_(descriptor) {}

McapWriter::~McapWriter() {
  if (messages_ > 0 || !index_.empty()) (void)finish();
  if (descriptor_ >= 0) close(descriptor_);
}

Result<std::unique_ptr<McapWriter>> McapWriter::create(const std::string& path, bool overwrite) {
  auto file = AtomicFile::create(path, overwrite);
  if (!file) return tl::unexpected(file.error());
  const int descriptor = file->open();
  if (descriptor < 0)
    return fail(std::string("cannot create the file: ") + std::strerror(errno), path,
                "check the folder and its permissions");
  return std::unique_ptr<McapWriter>(new McapWriter(path, std::move(*file), descriptor));
}

std::uint16_t McapWriter::schema_of(const NewMessage& message) {
  const auto [known, added] = schema_ids_.try_emplace(message.type, static_cast<std::uint16_t>(schemas_.size() + 1));
  if (!added) return known->second;
  Bytes& record = schemas_.emplace_back();
  RecordWriter writer(record);
  writer.begin(Kind::schema);
  writer.put(known->second);
  writer.put_text(message.type);
  writer.put_text("ros2msg");
  writer.put_text(message.schema);
  writer.end();
  new_records_.insert(new_records_.end(), record.begin(), record.end());
  return known->second;
}

/// The channel of a message, which is added if it is new. A topic whose metadata change continues as another channel.
std::uint16_t McapWriter::channel_of(const NewMessage& message) {
  // Equal topic, type and metadata make the same channel.
  std::string key = message.topic + '\n' + message.type;
  for (const auto& [name, value] : message.metadata) key.append('\n' + name + '\n' + value);
  const auto [known, added] = channel_ids_.try_emplace(key, static_cast<std::uint16_t>(channels_.size() + 1));
  if (!added) return known->second;

  // Make the record of a new channel, which precedes the next chunk and is repeated in the summary.
  const std::uint16_t schema = schema_of(message);
  Bytes& record = channels_.emplace_back().record;
  RecordWriter writer(record);
  writer.begin(Kind::channel);
  writer.put(known->second);
  writer.put(schema);

  // Add the topic, the encoding of its messages and its metadata.
  writer.put_text(message.topic);
  writer.put_text("cdr");
  writer.put_map(message.metadata);
  writer.end();
  new_records_.insert(new_records_.end(), record.begin(), record.end());
  return known->second;
}

Result<void> McapWriter::write(std::span<const NewMessage> messages, std::uint64_t time, std::uint32_t sequence) {
  if (descriptor_ < 0) return fail("the file is finished, nothing more is written", path_);
  if (failed_) return fail("an earlier write failed and could not be undone, nothing more is written", path_);

  // Add the messages to the chunk.
  const std::size_t before = records_.size();
  if (index_.empty()) chunk_start_ = time;
  for (const NewMessage& message : messages) {
    const std::uint16_t channel = channel_of(message);
    index_[channel].push_back({time, records_.size()});

    // Write the message as a record of the chunk.
    RecordWriter writer(records_);
    writer.begin(Kind::message);
    writer.put(channel);
    writer.put(sequence);
    writer.put(time);  // the time of recording, then that of sending
    writer.put(time);
    writer.put_bytes(message.bytes);
    writer.end();
  }

  // Write the chunk if it is full.
  const bool full = records_.size() >= kChunkSize || time - chunk_start_ >= kChunkTime;
  if (!full) return {};
  auto written = write_chunk();
  if (!written) take_back(before);
  return written;
}

/// Removes the messages that were added to the chunk after it had this size.
void McapWriter::take_back(std::size_t size) {
  records_.resize(size);
  for (auto& [channel, stamps] : index_)
    std::erase_if(stamps, [&](const Stamp& stamp) { return stamp.offset >= size; });
  std::erase_if(index_, [](const auto& entry) { return entry.second.empty(); });
}

McapWriter::Span McapWriter::span_of(const Index& index) {
  Span span{UINT64_MAX, 0};
  for (const auto& [channel, stamps] : index)
    for (const Stamp& stamp : stamps) span = {std::min(span.first, stamp.time), std::max(span.last, stamp.time)};
  return span;
}

McapWriter::Bytes McapWriter::chunk_record(Span span) const {
  // Compress the records of the chunk.
  const Bytes packed = compressed(records_);
  Bytes bytes;
  RecordWriter writer(bytes);
  writer.begin(Kind::chunk);
  writer.put(span.first);
  writer.put(span.last);

  // Add the size and the checksum of the records, then the compressed records.
  writer.put<std::uint64_t>(records_.size());
  writer.put(crc_of(0, records_));
  writer.put_text(kZstd);
  writer.put<std::uint64_t>(packed.size());
  writer.put_bytes(packed);
  writer.end();
  return bytes;
}

Result<void> McapWriter::write_chunk() {
  // Write the beginning of the file, if this is the first chunk, and new schemas and channels.
  Bytes bytes;
  RecordWriter writer(bytes);
  if (good_ == 0) {
    bytes.assign(kMagic.begin(), kMagic.end());
    writer.begin(Kind::header);
    writer.put_text("ros2");
    writer.put_text("barehand");
    writer.end();
  }
  writer.put_bytes(new_records_);

  // Write the chunk and the index of its messages.
  const Span span = span_of(index_);
  const std::uint64_t start = good_ + bytes.size();
  const Bytes chunk = chunk_record(span);
  writer.put_bytes(chunk);

  // Write an index for each channel, and note where it begins.
  const std::uint64_t index_start = good_ + bytes.size();
  std::map<std::uint16_t, std::uint64_t> index_offsets;
  for (const auto& [channel, stamps] : index_) {
    index_offsets[channel] = good_ + bytes.size();
    writer.begin(Kind::message_index);
    writer.put(channel);
    writer.put(static_cast<std::uint32_t>(stamps.size() * sizeof(Stamp)));
    for (const Stamp& stamp : stamps) writer.put(stamp);
    writer.end();
  }

  // Append everything at once, so that a failed write can be undone as a whole.
  const std::uint64_t index_size = good_ + bytes.size() - index_start;
  if (auto appended = append(bytes); !appended) return appended;

  // Store where the chunk is, for the index at the end of the file.
  Bytes& entry = chunk_indexes_.emplace_back();
  RecordWriter index(entry);
  index.begin(Kind::chunk_index);
  index.put(span.first);
  index.put(span.last);
  index.put(start);

  // Add the sizes of the chunk and the places of its message indexes.
  index.put<std::uint64_t>(chunk.size());
  index.put_map(index_offsets);
  index.put(index_size);
  index.put_text(kZstd);
  index.put<std::uint64_t>(chunk.size() - kChunkFields);
  index.put<std::uint64_t>(records_.size());
  index.end();

  // Update the statistics and begin a new chunk.
  span_ = {messages_ == 0 ? span.first : std::min(span_.first, span.first), std::max(span_.last, span.last)};
  for (const auto& [channel, stamps] : index_) {
    channels_[channel - 1U].messages += stamps.size();
    messages_ += stamps.size();
  }
  new_records_.clear();
  records_.clear();
  index_.clear();
  return {};
}

McapWriter::Bytes McapWriter::statistics() const {
  // Count the messages of each channel, whose numbers start at 1.
  std::map<std::uint16_t, std::uint64_t> counts;
  for (std::size_t i = 0; i < channels_.size(); ++i) counts[static_cast<std::uint16_t>(i + 1)] = channels_[i].messages;

  // Write the numbers of messages and other records, in the order of the format.
  Bytes bytes;
  RecordWriter writer(bytes);
  writer.begin(Kind::statistics);
  writer.put(messages_);
  writer.put(static_cast<std::uint16_t>(schemas_.size()));
  writer.put(static_cast<std::uint32_t>(channels_.size()));
  writer.put<std::uint32_t>(0);  // number of attachments
  writer.put<std::uint32_t>(0);  // number of metadata records
  writer.put(static_cast<std::uint32_t>(chunk_indexes_.size()));

  // Add the period of the recording, and the number of messages in each channel.
  writer.put(span_.first);
  writer.put(span_.last);
  writer.put_map(counts);
  writer.end();
  return bytes;
}

/// What follows the last chunk: the summary, the offsets of its groups of records, and the footer.
McapWriter::Bytes McapWriter::ending() const {
  // Mark the end of the data, with its checksum.
  Bytes bytes;
  RecordWriter writer(bytes);
  writer.begin(Kind::data_end);
  writer.put(crc_);
  writer.end();

  // Write the summary: the records in groups of one kind, then the offset of each group.
  const std::size_t summary = bytes.size();
  Bytes offsets;

  // Write a group, and note its place for the list of offsets.
  const auto group = [&](Kind kind, const auto& put_records) {
    const std::size_t start = bytes.size();
    put_records();
    RecordWriter offset(offsets);
    offset.begin(Kind::summary_offset);
    offset.put(kind);
    offset.put<std::uint64_t>(good_ + start);
    offset.put<std::uint64_t>(bytes.size() - start);
    offset.end();
  };

  // Write the groups, with the schemas first, since the channels refer to them.
  group(Kind::schema, [&] {
    for (const Bytes& schema : schemas_) writer.put_bytes(schema);
  });
  group(Kind::channel, [&] {
    for (const Channel& channel : channels_) writer.put_bytes(channel.record);
  });
  group(Kind::statistics, [&] { writer.put_bytes(statistics()); });
  group(Kind::chunk_index, [&] {
    for (const Bytes& index : chunk_indexes_) writer.put_bytes(index);
  });

  // Write the list of offsets behind the groups.
  const std::size_t offsets_start = bytes.size();
  writer.put_bytes(offsets);

  // Write the footer. Its checksum covers the summary and the footer up to the checksum.
  writer.put(Kind::footer);
  writer.put<std::uint64_t>(20);
  writer.put<std::uint64_t>(good_ + summary);
  writer.put<std::uint64_t>(good_ + offsets_start);
  writer.put(crc_of(0, Bytes(bytes.begin() + static_cast<std::ptrdiff_t>(summary), bytes.end())));
  bytes.insert(bytes.end(), kMagic.begin(), kMagic.end());
  return bytes;
}

Result<void> McapWriter::finish() {
  if (descriptor_ < 0) return {};
  Result<void> result;
  if (!index_.empty() && !failed_) result = write_chunk();

  // Write the index; readers can do without it if this fails.
  if (!failed_ && good_ > 0)
    if (auto ended = append(ending()); !ended && result) result = ended;

  // Close the file, and give it its final name unless it is empty.
  close(std::exchange(descriptor_, -1));
  if (good_ == 0) {  // nothing was written, so no file must get the name
    file_.discard();
    return result;
  }
  const std::string draft = file_.draft();
  const auto named = file_.finish();
  if (!named) path_ = draft;
  return result ? named : result;
}

Result<void> McapWriter::append(const Bytes& bytes) {
  constexpr std::chrono::milliseconds kPatience{100};  // longest wait for the reader of a pipe (pipe_room.h)
  const auto end_of_patience = std::chrono::steady_clock::now() + kPatience;

  // Write all bytes, and wait a little for the reader of a pipe.
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EAGAIN && wait_for_room(descriptor_, end_of_patience)) continue;
    if (written < 0) break;
    done += static_cast<std::size_t>(written);
  }

  // Count what is now safely in the file.
  if (done == bytes.size()) {
    good_ += bytes.size();
    crc_ = crc_of(crc_, bytes);
    start_write_back();
    return {};
  }

  // Cut the file back to the end of the last complete chunk, if that is possible.
  const int reason = errno;
  const auto end = static_cast<off_t>(good_);
  failed_ = file_.direct() || ftruncate(descriptor_, end) != 0 || lseek(descriptor_, end, SEEK_SET) != end;
  const std::string why = reason == EAGAIN ? "the reader of this pipe is behind" : std::strerror(reason);
  return fail("cannot be written: " + why, path_,
              failed_ ? "the file ends in an incomplete chunk, which readers skip"
                      : "the " + std::to_string(messages_) + " messages before are kept; free some space");
}

/// Lets the operating system write the data to the disk in pieces, so that finish() need not wait for all of a large
/// file.
void McapWriter::start_write_back() {
  constexpr std::uint64_t kPiece = 8 << 20;
  if (good_ - written_back_ < kPiece) return;
  (void)sync_file_range(descriptor_, static_cast<off_t>(written_back_), static_cast<off_t>(good_ - written_back_),
                        SYNC_FILE_RANGE_WRITE);
  written_back_ = good_;
}

}  // namespace barehand::mcap
