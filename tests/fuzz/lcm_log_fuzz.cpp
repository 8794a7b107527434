#include "drivers/lcm/lcm_log_source.h"
#include "fuzz/memory_file.h"

/// Input: an LCM log. Every event is read, and the frames in it are played.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const fuzz::MemoryFile file(data, size);
  auto reader = LcmLogReader::open(file.path());
  if (!reader) return 0;

  std::int64_t bytes = reader->damaged_bytes();
  for (const LogEntry& entry : reader->entries()) {
    const auto message = reader->read(entry);
    CHECK(message && message->size() == static_cast<std::size_t>(entry.size));
    bytes += 28 + static_cast<std::int64_t>(entry.channel.size()) + entry.size;
  }
  CHECK(bytes == static_cast<std::int64_t>(size));  // every byte belongs to an event or is counted as damaged

  // Play the log as a source of frames until it ends.
  LcmLogOptions options;
  options.foreign = {500, 500, 3, 2};
  for (const char* channel : {"", "*"}) {
    options.channel = channel;
    auto source = LcmLogSource::open(file.path(), options);
    if (!source) continue;
    while (!std::holds_alternative<EndOfStream>((*source)->next({}))) {
    }
  }
  return 0;
}
