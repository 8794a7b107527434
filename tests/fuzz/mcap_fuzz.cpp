#include "drivers/mcap/mcap_source.h"
#include "fuzz/memory_file.h"
#include "io/lcm/message_log.h"
#include "sensor/camera_limits.h"

/// Input: an MCAP file. Every message is read, those of hands too, and the depth images are played.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const fuzz::MemoryFile file(data, size);

  // Every message can be read again.
  std::vector<mcap::Message> messages;
  auto reader =
      mcap::McapReader::open(file.path(), [&](const auto& message, const auto&, std::span<const std::uint8_t> bytes) {
        CHECK(bytes.size() == message.size);
        messages.push_back(message);
      });
  if (!reader) return 0;
  for (const mcap::Message& message : messages) {
    const auto bytes = reader->read(message);
    CHECK(bytes && bytes->size() == message.size);
  }

  // The LCM messages of hands.
  auto log = MessageLog::open(file.path());
  CHECK(log);
  for (const LogEntry& entry : log->entries()) {
    const auto message = log->read(entry);
    CHECK(message && message->size() == static_cast<std::size_t>(entry.size));
  }

  // The frames of all topics with depth.
  McapOptions options;
  options.channel = "*";
  options.foreign = {500, 500, 3, 2};
  auto source = McapSource::open(file.path(), options);
  if (!source) return 0;

  // Every frame must be consistent in itself.
  while (true) {
    const SourceEvent event = (*source)->next({});
    if (std::holds_alternative<EndOfStream>(event)) return 0;
    if (const auto* frame = std::get_if<FramePtr>(&event)) {
      const RgbdFrame& one = **frame;
      CHECK(plausible(one.camera) && one.depth_unit >= 1e-7 && one.depth_unit <= 1);
      CHECK(one.depth.width() == one.camera.width && one.depth.height() == one.camera.height);
      CHECK(one.colour.empty() || one.colour.size() == one.depth.size());
    }
  }
}
