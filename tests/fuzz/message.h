#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "drivers/lcm/layouts.h"
#include "fuzz/check.h"

namespace barehand::fuzz {

/// The input as a message of this type: its first bytes are replaced by the type's fingerprint.
template <class Message>
std::vector<std::uint8_t> message_of(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  if (bytes.size() < 8) bytes.resize(8);
  const auto hash = static_cast<std::uint64_t>(Message::getHash());
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
  return bytes;
}

/// Decodes the input as a message. Encoding an accepted message must give the same bytes.
template <class Message>
void decode(const std::uint8_t* data, std::size_t size) {
  const auto bytes = message_of<Message>(data, size);
  const auto message = decode_message<Message>(bytes);
  if (message) CHECK(encode_message(*message) == bytes);
}

}  // namespace barehand::fuzz
