#include "drivers/mcap/mcap_source.h"
#include "fuzz/memory_file.h"
#include "sensor/camera_limits.h"

/// Input: an MCAP file. Every message is read, and the depth images in it are played.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const fuzz::MemoryFile file(data, size);
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

  McapOptions options;
  options.channel = "*";
  options.foreign = {500, 500, 3, 2};
  auto source = McapSource::open(file.path(), options);
  if (!source) return 0;
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
