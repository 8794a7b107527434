#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

using WireBytes = std::span<const std::uint8_t>;

/// Steps over an encoded LCM message (big endian) without trusting it: once a length is negative or larger than the
/// rest of the message, `ok` stays false. Generated decoders trust every length, so decode_message checks a message
/// with this class first.
class WireWalker {
 public:
  explicit WireWalker(WireBytes bytes) : left_(bytes) {}

  void skip(std::int64_t bytes);
  std::int64_t int64();
  std::int32_t int32();
  void string();      ///< steps over a string: length (with the final NUL), characters other than NUL, NUL
  void byte_array();  ///< steps over `int32_t n; byte data[n];`
  /// Reads n of `int32_t n; element data[n];`. Returns 0 if the message is too short for n elements of `least` bytes.
  std::int32_t count(std::int64_t least);

  bool ok() const { return ok_; }
  /// Whether the walk ended exactly at the end of the message.
  bool complete() const { return ok_ && left_.empty(); }

 private:
  std::uint64_t big_endian(std::size_t bytes);

  WireBytes left_;
  bool ok_ = true;
};

/// The 64-bit word at `index` of an encoded message, 0 if the message is too short. Word 0 is the type's fingerprint;
/// word 1 is the time stamp [us] in every type that is read here; word 2 of rgbd_frame_t is its `seq`.
std::int64_t message_word(WireBytes message, int index);
inline std::int64_t message_hash(WireBytes message) { return message_word(message, 0); }

/// Encodes a message, including the fingerprint of its type.
template <class Message>
std::vector<std::uint8_t> encode_message(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// Decodes a message of a type for which there is a `walk(WireWalker&, const Message*)`. Errors: a message of another
/// type, or one that is truncated, too long or contains a wrong length.
template <class Message>
Result<Message> decode_message(WireBytes bytes) {
  if (message_hash(bytes) != Message::getHash()) {
    return fail(std::string("message is not a ") + Message::getTypeName(), "",
                "check the channel and the type's version");
  }
  WireWalker walker(bytes.subspan(8));
  walk(walker, static_cast<const Message*>(nullptr));
  Message message;
  if (!walker.complete() || message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) {
    return fail(std::string("damaged ") + Message::getTypeName());
  }
  return message;
}

}  // namespace barehand
