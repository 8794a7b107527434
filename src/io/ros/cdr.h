#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/ros/schema.h"

namespace barehand::ros {

using Bytes = std::vector<std::uint8_t>;

/// Encodes the fields of a message in CDR, little endian, with the header of four bytes.
class CdrWriter {
 public:
  CdrWriter();
  ~CdrWriter();
  template <class T>
  void operator()(const char*, const T& value) {
    put(value);
  }
  Bytes take() const;

 private:
  template <Message M>
  void put(const M& message) {
    M::fields(*this, message);
  }
  template <class T, std::size_t N>
  void put(const std::array<T, N>& values) {
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint32_t>(values.size()));
    for (const T& value : values) put(value);
  }
  void put(const Bytes& bytes);
  void put(bool value);
  void put(std::byte value);
  void put(std::uint8_t value);
  void put(std::int32_t value);
  void put(std::uint32_t value);
  void put(float value);
  void put(double value);
  void put(const std::string& value);
  template <class T>
  void put_aligned(const T& value, std::size_t size);

  struct Stream;
  std::unique_ptr<Stream> stream_;
};

/// Decodes the fields of a message from bytes that may be damaged: if they end early, the remaining fields are zero and
/// failed() is true. Lengths that exceed the bytes are rejected. Accepts both byte orders.
class CdrReader {
 public:
  /// `bytes` must outlive the reader.
  explicit CdrReader(std::span<const std::uint8_t> bytes);
  ~CdrReader();
  template <class T>
  void operator()(const char*, T& value) {
    get(value);
  }
  bool failed() const { return failed_; }

 private:
  template <Message M>
  void get(M& message) {
    M::fields(*this, message);
  }
  template <class T, std::size_t N>
  void get(std::array<T, N>& values) {
    for (T& value : values) get(value);
  }
  template <class T>
  void get(std::vector<T>& values) {
    const std::uint32_t count = length();
    for (std::uint32_t i = 0; i < count && !failed_; ++i) get(values.emplace_back());
  }
  void get(Bytes& bytes);
  void get(bool& value);
  void get(std::uint8_t& value);
  void get(std::int32_t& value);
  void get(std::uint32_t& value);
  void get(double& value);
  void get(std::string& value);
  template <class T>
  void take(T& value);
  std::uint32_t length();

  struct Stream;
  std::unique_ptr<Stream> stream_;  // null: the bytes are not CDR
  bool failed_ = false;
};

template <Message M>
Bytes encode(const M& message) {
  CdrWriter writer;
  M::fields(writer, message);
  return writer.take();
}

/// Decodes a message; bytes after it are ignored. Error: the message ends early, or the bytes are not CDR.
template <Message M>
Result<M> decode(std::span<const std::uint8_t> bytes) {
  CdrReader reader(bytes);
  M message;
  M::fields(reader, message);
  if (reader.failed()) return fail(std::string("is no complete ") + M::kType + " in CDR");
  return message;
}

}  // namespace barehand::ros
