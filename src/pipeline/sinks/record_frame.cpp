#include "pipeline/sinks/record_frame.h"

#include "drivers/lcm/frame_codec.h"
#include "drivers/lcm/wire.h"
#include "stages/publish/publisher.h"

namespace barehand {

Result<void> record_frame(MessageSink& log, const std::string& prefix, const RgbdFrame& frame,
                          std::span<const HandMessages> hands, std::span<const object_state_t> objects) {
  const auto image = encode_frame(frame, {});
  if (!image) return tl::unexpected(image.error());
  auto written = log.send(prefix + "RGBD_FRAME", encode_message(*image), frame.utime);

  auto publisher = Publisher::create(prefix, {&log});
  if (!publisher) return tl::unexpected(publisher.error());
  for (const HandMessages& hand : hands) {
    if (written) written = publisher->send_hand(hand);
    if (written) written = publisher->send_findings(hand);
  }
  for (const object_state_t& object : objects)
    if (written) written = publisher->send(object);
  return written;
}

}  // namespace barehand
