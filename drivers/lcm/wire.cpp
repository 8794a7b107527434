// Checks the lengths in an encoded LCM message before it is decoded.
#include "drivers/lcm/wire.h"

#include <cstring>

namespace barehand {

void WireWalker::skip(std::int64_t bytes) {
  ok_ = ok_ && bytes >= 0 && bytes <= static_cast<std::int64_t>(left_.size());
  if (ok_) left_ = left_.subspan(static_cast<std::size_t>(bytes));
}

std::uint64_t WireWalker::big_endian(std::size_t bytes) {
  const WireBytes field = left_;
  skip(static_cast<std::int64_t>(bytes));
  if (!ok_) return 0;
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value = value << 8 | field[i];
  return value;
}

std::int64_t WireWalker::int64() { return static_cast<std::int64_t>(big_endian(8)); }
std::int32_t WireWalker::int32() { return static_cast<std::int32_t>(big_endian(4)); }

void WireWalker::string() {
  const std::int32_t length = int32();
  ok_ = ok_ && length >= 1;
  const WireBytes text = left_;
  skip(length);
  ok_ = ok_ &&
        std::memchr(text.data(), 0, static_cast<std::size_t>(length)) == &text[static_cast<std::size_t>(length) - 1];
}

void WireWalker::byte_array() { skip(int32()); }

std::int32_t WireWalker::count(std::int64_t least) {
  const std::int32_t n = int32();
  ok_ = ok_ && n >= 0 && n * least <= static_cast<std::int64_t>(left_.size());
  return ok_ ? n : 0;
}

std::int64_t message_word(WireBytes message, int index) {
  WireWalker walker(message);
  walker.skip(8 * index);
  return walker.int64();
}

}  // namespace barehand
