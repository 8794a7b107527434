// The sink that writes frames and hands to an MCAP file.
#include "pipeline/sinks/mcap_sink.h"

#include "io/mcap/mcap_scene.h"
#include "stages/publish/health_message.h"

namespace barehand {
namespace {
constexpr std::int64_t kHealthPeriodUs = 1'000'000;  // minimum time between two health messages
}

McapSink::McapSink(const PublishParams& params, std::unique_ptr<mcap::McapWriter> file, Input input, const Clock& clock,
                   Slot<PublishParams>* pending)
    : makers_(params, pending), file_(std::move(file)), input_(std::move(input)), clock_(clock) {}

Result<std::unique_ptr<Sink>> McapSink::create(const PublishParams& params, const std::string& path, bool overwrite,
                                               Input input, const Clock& clock, Slot<PublishParams>* pending) {
  auto file = mcap::McapWriter::create(path, overwrite);
  if (!file) return tl::unexpected(file.error());
  return std::unique_ptr<Sink>(new McapSink(params, std::move(*file), std::move(input), clock, pending));
}

Result<void> McapSink::consume(const TrackedFrame& tracked) {
  // Collect what is written about this frame, and write it.
  ros::Scene scene;
  scene.utime = tracked.frame->utime;
  scene.number = tracked.frame->number;
  scene.frame = tracked.frame;
  scene.fps = input_.fps;
  scene.T_world_camera = input_.T_world_camera;

  // Add the hands and the objects.
  const FrameMessages messages = makers_.process(tracked);
  for (const HandMessages& hand : messages.hands)
    scene.hands.push_back({hand.state, hand.glove, hand.joints, hand.contact, hand.grasp});
  scene.objects.assign(messages.objects.begin(), messages.objects.end());

  // Add the health of a live run from time to time.
  if (input_.live && clock_.steady_us() - health_us_ >= kHealthPeriodUs) {
    health_us_ = clock_.steady_us();
    scene.health = health_message(input_.health(), clock_.utime(), input_.source);
  }
  return mcap::write_scene(*file_, scene).map([&] { ++frames_; });
}

}  // namespace barehand
