#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace barehand {

/// Writes the chunks of a binary message on the page's WebSocket. Numbers are little endian, as JavaScript's typed
/// arrays read them. A chunk consists of its kind (1 byte, a letter), an index (1), zero (2), the length of the payload
/// (4), the payload, and zeros up to a multiple of 4 bytes. docs/view_protocol.md lists the kinds.
class ChunkWriter {
 public:
  static_assert(std::endian::native == std::endian::little);
  explicit ChunkWriter(std::vector<std::uint8_t>& out) : out_(out) {}

  void begin(char kind, int index = 0) {
    start_ = out_.size();
    put<std::uint8_t>(static_cast<std::uint8_t>(kind));
    put<std::uint8_t>(static_cast<std::uint8_t>(index));
    put<std::uint16_t>(0);
    put<std::uint32_t>(0);  // the length, filled in by end()
  }
  void end() {
    const auto length = static_cast<std::uint32_t>(out_.size() - start_ - kHeader);
    std::memcpy(out_.data() + start_ + 4, &length, sizeof length);
    while (out_.size() % 4 != 0) out_.push_back(0);
  }

  template <class T>
  void put(T value) {
    out_.resize(out_.size() + sizeof value);
    std::memcpy(out_.data() + out_.size() - sizeof value, &value, sizeof value);
  }
  void put_bytes(std::span<const std::uint8_t> bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }

 private:
  static constexpr std::size_t kHeader = 8;
  std::vector<std::uint8_t>& out_;
  std::size_t start_ = 0;
};

}  // namespace barehand
