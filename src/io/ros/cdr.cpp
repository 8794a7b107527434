// Encodes and decodes ROS 2 messages in CDR.
#include "io/ros/cdr.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/exceptions/Exception.h>

#include <cstring>

namespace barehand::ros {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

struct CdrWriter::Stream {
  FastBuffer buffer;
  Cdr cdr{buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR};
};

CdrWriter::CdrWriter() : stream_(std::make_unique<Stream>()) { stream_->cdr.serialize_encapsulation(); }
CdrWriter::~CdrWriter() = default;

Bytes CdrWriter::take() const {
  const char* first = stream_->buffer.getBuffer();
  return Bytes(first, first + stream_->cdr.getSerializedDataLength());
}

/// Fills the padding before an aligned number with zeros. Fast CDR would leave these bytes uninitialised: equal
/// messages would differ and could leak the content of memory.
template <class T>
void CdrWriter::put_aligned(const T& value, std::size_t size) {
  constexpr std::size_t kHeader = 4;
  while ((stream_->cdr.getSerializedDataLength() - kHeader) % size != 0) stream_->cdr.serialize(std::uint8_t{0});
  stream_->cdr.serialize(value);
}

void CdrWriter::put(const Bytes& bytes) {
  put(static_cast<std::uint32_t>(bytes.size()));
  stream_->cdr.serializeArray(bytes.data(), bytes.size());
}
void CdrWriter::put(bool value) { stream_->cdr.serialize(value); }
void CdrWriter::put(std::byte value) { put(static_cast<std::uint8_t>(value)); }
void CdrWriter::put(std::uint8_t value) { stream_->cdr.serialize(value); }
void CdrWriter::put(std::int32_t value) { put_aligned(value, sizeof value); }
void CdrWriter::put(std::uint32_t value) { put_aligned(value, sizeof value); }
void CdrWriter::put(float value) { put_aligned(value, sizeof value); }
void CdrWriter::put(double value) { put_aligned(value, sizeof value); }
void CdrWriter::put(const std::string& value) { put_aligned(value, sizeof(std::uint32_t)); }

struct CdrReader::Stream {
  explicit Stream(std::span<const std::uint8_t> bytes)
      : buffer(reinterpret_cast<char*>(const_cast<std::uint8_t*>(bytes.data())), bytes.size()),
        cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR),
        end(reinterpret_cast<const char*>(bytes.data()) + bytes.size()) {
    cdr.read_encapsulation();
  }
  std::size_t remaining() { return static_cast<std::size_t>(end - cdr.getCurrentPosition()); }
  FastBuffer buffer;
  Cdr cdr;
  const char* end;
};

CdrReader::CdrReader(std::span<const std::uint8_t> bytes) {
  // Accept plain CDR only: the header's first byte is 0, the second one is the byte order.
  const bool plain = bytes.size() >= 4 && bytes[0] == 0 && bytes[1] <= 1;
  failed_ = !plain;
  if (plain) stream_ = std::make_unique<Stream>(bytes);
}
CdrReader::~CdrReader() = default;

template <class T>
void CdrReader::take(T& value) {
  if (failed_) return;
  try {
    stream_->cdr.deserialize(value);
  } catch (const eprosima::fastcdr::exception::Exception&) {
    failed_ = true;
    value = T{};
  }
}

/// Reads the length of a sequence; an element has at least one byte.
std::uint32_t CdrReader::length() {
  std::uint32_t count = 0;
  take(count);
  if (failed_ || count <= stream_->remaining()) return count;
  failed_ = true;
  return 0;
}

void CdrReader::get(Bytes& bytes) {
  const std::uint32_t count = length();
  if (failed_) return;
  bytes.resize(count);
  stream_->cdr.deserializeArray(bytes.data(), count);
}
void CdrReader::get(bool& value) {
  std::uint8_t byte = 0;
  take(byte);
  value = byte != 0;
}
void CdrReader::get(std::uint8_t& value) { take(value); }
void CdrReader::get(std::int32_t& value) { take(value); }
void CdrReader::get(std::uint32_t& value) { take(value); }
void CdrReader::get(double& value) { take(value); }
void CdrReader::get(std::string& value) { take(value); }

}  // namespace barehand::ros
