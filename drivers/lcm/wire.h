#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

using WireBytes = std::span<const std::uint8_t>;

/// Walks over an encoded LCM message (big endian) without believing it: once a length is negative or larger than what
/// is left, `ok` stays false. Generated decoders trust every length, so nothing reaches them before this walk.
class WireWalker {
 public:
  explicit WireWalker(WireBytes bytes) : left_(bytes) {}

  void skip(std::int64_t bytes);
  std::int64_t int64();
  std::int32_t int32();
  void string();      ///< length (with the final NUL), characters other than NUL, NUL
  void byte_array();  ///< for `int32_t n; byte data[n];`
  /// For `int32_t n; element data[n];`: n if that many elements of at least `least` bytes each may follow, else 0.
  std::int32_t count(std::int64_t least);

  bool ok() const { return ok_; }
  /// The whole message was walked over, neither less nor more.
  bool complete() const { return ok_ && left_.empty(); }

 private:
  std::uint64_t big_endian(std::size_t bytes);

  WireBytes left_;
  bool ok_ = true;
};

/// The 64-bit word number `index` of an encoded message, 0 if it is too short. Word 0 is the type's fingerprint, word
/// 1 in every type read here the time of the measurement [us], word 2 of rgbd_frame_t its `seq`.
std::int64_t message_word(WireBytes message, int index);
inline std::int64_t message_hash(WireBytes message) { return message_word(message, 0); }

/// `message` encoded with its fingerprint.
template <class Message>
std::vector<std::uint8_t> encode_message(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// Decodes a message whose layout `walk(WireWalker&, const Message*)` knows: wrong type, truncated, too long or with
/// a lying length is an error.
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
