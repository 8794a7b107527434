// Reads an MCAP file: its channels, its messages and their positions.
#include "io/mcap/mcap_reader.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "io/mcap/mcap_format.h"

namespace barehand::mcap {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMostUnpacked = 256 << 20;  // largest accepted size of an unpacked chunk [bytes]
constexpr std::uint64_t kMessageFields = 22;        // size of the fields before the data in a message record [bytes]

/// The error for a chunk with another compression than zstd.
std::string unknown_compression(const std::string& name) {
  return "packed with " + name + ", which is not read: repack the file with `mcap compress --compression zstd`";
}

Result<void> unpack_zstd(std::span<const std::uint8_t> packed, std::uint64_t size, std::vector<std::uint8_t>& out) {
  const auto stated = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (stated != ZSTD_CONTENTSIZE_UNKNOWN && stated != size) return fail("damaged");
  out.resize(size);
  const std::size_t got = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0 || got != size) return fail("damaged");
  return {};
}

}  // namespace

bool is_mcap(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  std::array<char, kMagic.size()> start{};
  return std::ifstream(path, std::ios::binary).read(start.data(), start.size()) &&
         std::string_view(start.data(), start.size()) == kMagic;
}

Result<McapReader> McapReader::open(const std::string& path, const MessageVisitor& visit) {
  if (!is_mcap(path)) return fail("is not an MCAP file", path, "give one, an LCM log or a recording folder");
  McapReader reader(path);
  if (const auto opened = reader.open_file(); !opened) return tl::unexpected(opened.error());
  reader.scan(visit);
  return reader;
}

Result<void> McapReader::open_file() {
  file_.reset(std::fopen(path_.c_str(), "rb"));
  if (!file_) return fail(std::string("cannot open the file: ") + std::strerror(errno), path_);
  std::error_code error;
  size_ = fs::file_size(path_, error);
  if (error) return fail("cannot determine the size of the file: " + error.message(), path_);
  return {};
}

bool McapReader::read_at(std::uint64_t at, std::uint64_t size, Bytes& out) {
  if (at > size_ || size > size_ - at) return false;
  out.resize(size);
  return fseeko(file_.get(), static_cast<off_t>(at), SEEK_SET) == 0 &&
         std::fread(out.data(), 1, out.size(), file_.get()) == out.size();
}

void McapReader::warn(std::string what) { warnings_.push_back(path_ + ": " + std::move(what)); }

void McapReader::scan(const MessageVisitor& visit) {
  // Go from record to record.
  std::uint64_t lost = 0;  // number of bytes that are not part of a record
  bool ended = false;
  for (std::uint64_t at = kMagic.size(); at < size_ && !ended;) {
    // Read the kind and the size of the record.
    Bytes header;
    std::uint64_t size = 0;
    const bool known = read_at(at, kRecordHeader, header);
    if (known) std::memcpy(&size, &header[1], sizeof size);
    const std::uint64_t content = at + kRecordHeader;

    // Process the record if it is complete and valid.
    if (known && size <= size_ - content && take_record(header[0], content, size, visit)) {
      ended = header[0] == static_cast<std::uint8_t>(Kind::data_end);
      at = content + size;
      continue;
    }

    // There is no valid record here: skip to the next chunk.
    const std::uint64_t next = next_chunk(at + 1).value_or(size_);
    lost += next - at;
    at = next;
  }

  // Report what was left out.
  if (lost > 0)
    warn(std::to_string(lost) + " bytes are damaged or cut off; every complete chunk is used");
  else if (!ended)
    warn("it was not finished, as by a recorder that was killed; every complete chunk is used");
  for (const auto& [reason, count] : left_out_)
    warn((count == 1 ? "a chunk is left out, " : std::to_string(count) + " chunks are left out, ") + reason);
}

/// Processes a record whose content has `size` bytes and begins at `at`. Returns false if this is not an MCAP record.
bool McapReader::take_record(std::uint8_t kind, std::uint64_t at, std::uint64_t size, const MessageVisitor& visit) {
  // Read the content only where it is needed: other kinds may be large.
  const auto read = [&] {
    return read_at(at, size, record_) ? std::span<const std::uint8_t>(record_) : std::span<const std::uint8_t>();
  };

  // Process the record by its kind.
  switch (static_cast<Kind>(kind)) {
    case Kind::schema:
      take_schema(read());
      return true;
    case Kind::channel:
      take_channel(read());
      return true;

    // A message may also stand outside of any chunk.
    case Kind::message:
      take_message(read(), -1, at, visit);
      return true;
    case Kind::chunk:
      chunk_sizes_[static_cast<std::int64_t>(at)] = size;
      take_chunk(at, visit);
      return true;
    default:
      return kind != 0;  // attachments, indexes and kinds of later versions are skipped
  }
}

void McapReader::take_schema(std::span<const std::uint8_t> record) {
  FieldReader fields(record);
  const auto id = fields.get<std::uint16_t>();
  Schema schema{fields.get_text(), fields.get_text()};
  if (!fields.failed() && id != 0) schemas_[id] = std::move(schema);
}

void McapReader::take_channel(std::span<const std::uint8_t> record) {
  FieldReader fields(record);
  const auto id = fields.get<std::uint16_t>(), schema = fields.get<std::uint16_t>();
  Channel channel;
  channel.topic = fields.get_text();
  channel.encoding = fields.get_text();
  channel.metadata = fields.get_map();
  if (const auto known = schemas_.find(schema); known != schemas_.end()) {
    channel.type = known->second.name;
    channel.schema_encoding = known->second.encoding;
  }
  if (!fields.failed()) channels_[id] = std::move(channel);
}

void McapReader::take_message(std::span<const std::uint8_t> record, std::int64_t chunk, std::uint64_t at,
                              const MessageVisitor& visit) {
  FieldReader fields(record);
  Message message;
  message.channel = fields.get<std::uint16_t>();
  message.sequence = fields.get<std::uint32_t>();
  message.log_time = fields.get<std::uint64_t>();
  (void)fields.get<std::uint64_t>();  // the time of sending
  message.chunk = chunk;
  message.offset = at + kMessageFields;
  message.size = fields.rest().size();
  const auto channel = channels_.find(message.channel);
  if (!fields.failed() && channel != channels_.end()) visit(message, channel->second, fields.rest());
}

void McapReader::take_chunk(std::uint64_t at, const MessageVisitor& visit) {
  // Unpack the chunk, or count it as left out with the reason.
  if (const auto unpacked = unpack(at, chunk_sizes_[static_cast<std::int64_t>(at)]); !unpacked) {
    ++left_out_[unpacked.error().what];
    return;
  }
  const std::span<const std::uint8_t> all(chunk_);

  // Go from record to record, as in the file itself.
  for (std::uint64_t from = 0; all.size() - from >= kRecordHeader;) {
    std::uint64_t size = 0;
    std::memcpy(&size, &all[from + 1], sizeof size);
    const std::uint64_t content = from + kRecordHeader;
    if (size > all.size() - content) return;

    // Process the record by its kind; indexes do not occur in a chunk.
    const auto record = all.subspan(content, size);
    if (all[from] == static_cast<std::uint8_t>(Kind::schema)) take_schema(record);
    if (all[from] == static_cast<std::uint8_t>(Kind::channel)) take_channel(record);
    if (all[from] == static_cast<std::uint8_t>(Kind::message))
      take_message(record, static_cast<std::int64_t>(at), content, visit);
    from = content + size;
  }
}

/// Reads and unpacks a chunk into `chunk_`. The error is a phrase for the user, for which equal chunks are counted.
Result<void> McapReader::unpack(std::uint64_t at, std::uint64_t size) {
  chunk_at_ = -1;

  // Read the fields of the chunk.
  if (!read_at(at, size, record_)) return fail("unreadable");
  FieldReader fields(record_);
  (void)fields.get_bytes(16);  // first and last time
  const auto unpacked_size = fields.get<std::uint64_t>();
  const auto crc = fields.get<std::uint32_t>();
  const std::string compression = fields.get_text();
  const auto packed = fields.get_bytes(fields.get<std::uint64_t>());

  // Refuse a chunk that is damaged or would unpack to more than the limit.
  if (fields.failed()) return fail("damaged");
  if (unpacked_size > kMostUnpacked) return fail("which would take more than 256 MiB");

  // Unpack the records.
  if (compression == "zstd") {
    if (auto good = unpack_zstd(packed, unpacked_size, chunk_); !good) return good;
  } else if (compression.empty()) {
    chunk_.assign(packed.begin(), packed.end());
  } else {
    return fail(unknown_compression(compression));
  }

  // Check the records against their checksum, which is optional.
  if (crc != 0 && crc != crc32_z(0, chunk_.data(), chunk_.size())) return fail("damaged");
  chunk_at_ = static_cast<std::int64_t>(at);
  return {};
}

/// Finds the next position from `from` on at which a chunk compressed with zstd seems to begin, by its compression
/// field.
std::optional<std::uint64_t> McapReader::next_chunk(std::uint64_t from) {
  // The compression field is a length and a name, and stands at a fixed place in a chunk.
  constexpr std::string_view kSign("\4\0\0\0zstd", 8);
  constexpr std::uint64_t kBefore = kRecordHeader + 8 + 8 + 8 + 4;  // bytes before kSign in a chunk record

  // Read the file in blocks that overlap, so that no sign is missed at a boundary.
  Bytes block;
  for (std::uint64_t at = from + kBefore; at < size_; at += (1 << 16) - (kSign.size() - 1)) {
    if (!read_at(at, std::min<std::uint64_t>(1 << 16, size_ - at), block)) break;

    // Search the block for the sign.
    for (auto found = block.begin();; ++found) {
      found = std::search(found, block.end(), kSign.begin(), kSign.end());
      if (found == block.end()) break;

      // Check that a chunk record of plausible size begins before the sign.
      const std::uint64_t start = at + static_cast<std::uint64_t>(found - block.begin()) - kBefore;
      Bytes header;
      if (!read_at(start, kRecordHeader, header) || header[0] != static_cast<std::uint8_t>(Kind::chunk)) continue;
      std::uint64_t size = 0;
      std::memcpy(&size, &header[1], sizeof size);
      if (size <= size_ - start - kRecordHeader) return start;
    }
  }
  return std::nullopt;
}

Result<std::span<const std::uint8_t>> McapReader::read(const Message& message) {
  const auto changed = [&] { return fail("the file changed while it was read", path_); };
  if (message.chunk < 0) {
    if (!read_at(message.offset, message.size, record_)) return changed();
    return std::span<const std::uint8_t>(record_);
  }
  if (message.chunk != chunk_at_)
    if (const auto size = chunk_sizes_.find(message.chunk);
        size == chunk_sizes_.end() || !unpack(static_cast<std::uint64_t>(message.chunk), size->second))
      return changed();
  if (message.offset > chunk_.size() || message.size > chunk_.size() - message.offset) return changed();
  return std::span<const std::uint8_t>(chunk_).subspan(message.offset, message.size);
}

}  // namespace barehand::mcap
