#include "app/eval/stated_poses.h"

#include <cmath>

#include "fuzz/memory_file.h"
#include "fuzz/message.h"

namespace {

void put(std::vector<std::uint8_t>& bytes, std::uint64_t value, int count) {
  for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// A log that contains only this message.
std::vector<std::uint8_t> log_of(const std::vector<std::uint8_t>& message) {
  std::vector<std::uint8_t> bytes;
  put(bytes, 0xEDA1DA01, 4);
  put(bytes, 0, 8);
  put(bytes, 0, 8);
  put(bytes, 1, 4);
  put(bytes, message.size(), 4);
  bytes.push_back('H');
  bytes.insert(bytes.end(), message.begin(), message.end());
  return bytes;
}

}  // namespace

/// Input: a hand state message. It is decoded, and a log that contains it is read as `barehand eval` reads it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  fuzz::decode<hand_state_t>(data, size);
  const auto log = log_of(fuzz::message_of<hand_state_t>(data, size));
  const fuzz::MemoryFile file(log.data(), log.size());
  const auto stated = read_stated_poses(file.path());
  if (!stated) return 0;
  ResultTable truth;
  for (const auto& [number, pose] : *stated) truth.frames.push_back({number, pose.utime * 1e-6, {}});
  const auto reliability = evaluate_reliability({{truth, *stated}});
  CHECK(reliability && reliability->frames == stated->size() && std::isfinite(reliability->all.stated));
  return 0;
}
