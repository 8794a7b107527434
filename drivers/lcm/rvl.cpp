// The RVL code for depth images: run lengths of zeros and variable-length differences.
#include "drivers/lcm/rvl.h"

namespace barehand {
namespace {

/// Writes and reads numbers as nibbles, as rvl_encode describes.
class NibbleWriter {
 public:
  void number(std::uint32_t value) {
    do {
      const std::uint8_t nibble = (value & 7u) | (value > 7u ? 8u : 0u);
      if (high_) {
        bytes_.push_back(static_cast<std::uint8_t>(nibble << 4));
      } else {
        bytes_.back() |= nibble;
      }
      high_ = !high_;
      value >>= 3;
    } while (value != 0);
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  bool high_ = true;
};

class NibbleReader {
 public:
  explicit NibbleReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  /// Returns false at the end of the code and for a number of more than 30 bits.
  bool number(std::uint32_t& value) {
    value = 0;
    for (int shift = 0; shift < 30; shift += 3) {
      if (at_ >= 2 * bytes_.size()) return false;
      const std::uint8_t byte = bytes_[at_ / 2];
      const std::uint32_t nibble = at_ % 2 == 0 ? byte >> 4 : byte & 15u;
      ++at_;
      value |= (nibble & 7u) << shift;
      if ((nibble & 8u) == 0) return true;
    }
    return false;
  }
  bool at_end() const { return (at_ + 1) / 2 == bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

std::uint32_t zigzag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 31);
}
std::int32_t unzigzag(std::uint32_t code) {
  return static_cast<std::int32_t>(code >> 1) ^ -static_cast<std::int32_t>(code & 1u);
}

}  // namespace

std::vector<std::uint8_t> rvl_encode(std::span<const std::uint16_t> counts) {
  NibbleWriter out;
  std::int32_t previous = 0;
  for (std::size_t i = 0; i < counts.size();) {
    // Find the next run of pixels without depth, and the run of measured pixels after it.
    std::size_t measured = i;
    while (measured < counts.size() && counts[measured] == 0) ++measured;
    std::size_t end = measured;
    while (end < counts.size() && counts[end] != 0) ++end;

    // Write the lengths of both runs, and then the differences between successive measured pixels.
    out.number(static_cast<std::uint32_t>(measured - i));
    out.number(static_cast<std::uint32_t>(end - measured));
    for (i = measured; i < end; ++i) {
      out.number(zigzag(counts[i] - previous));
      previous = counts[i];
    }
  }
  return out.take();
}

Result<void> rvl_decode(std::span<const std::uint8_t> code, std::span<std::uint16_t> counts) {
  NibbleReader in(code);
  std::int32_t previous = 0;
  for (std::size_t i = 0; i < counts.size();) {
    // Read the lengths of the next two runs.
    std::uint32_t zeros = 0, measured = 0;
    if (!in.number(zeros) || !in.number(measured)) return fail("compressed depth ends too early");
    if (zeros + measured == 0 || zeros + measured > counts.size() - i)
      return fail("compressed depth with an invalid run length");

    // Fill in the pixels without depth, and sum up the differences between the measured ones.
    for (std::uint32_t k = 0; k < zeros; ++k) counts[i++] = 0;
    for (std::uint32_t k = 0; k < measured; ++k) {
      std::uint32_t difference = 0;
      if (!in.number(difference)) return fail("compressed depth ends too early");

      // Each count must be positive and fit into 16 bits.
      previous += unzigzag(difference);
      if (previous <= 0 || previous > 0xFFFF) return fail("compressed depth leaves the range of 16 bits");
      counts[i++] = static_cast<std::uint16_t>(previous);
    }
  }
  if (!in.at_end()) return fail("compressed depth is longer than the image");
  return {};
}

}  // namespace barehand
