#include "openni2/virtual_device/pictures.h"

#include "core/clock.h"
#include "drivers/synthetic/synthetic_source.h"

namespace barehand::virtual_openni {

const RgbdFrame& Pictures::at(std::int64_t index) const {
  const auto n = static_cast<std::int64_t>(frames.size());
  if (n == 1) return *frames[0];
  const std::int64_t place = index % (2 * n - 2);  // 0 ... n-1, n-2 ... 1
  return *frames[place < n ? place : 2 * n - 2 - place];
}

Result<Pictures> render_pictures(const std::string& sim, int count) {
  const SystemClock clock;
  auto source = synthetic::SyntheticSource::open(sim, clock);
  if (!source) return tl::unexpected(source.error());
  Pictures pictures;
  while (static_cast<int>(pictures.frames.size()) < count) {
    const SourceEvent event = (*source)->next(std::chrono::milliseconds(0));
    const auto* frame = std::get_if<FramePtr>(&event);
    if (!frame) break;
    pictures.frames.push_back(*frame);
  }
  if (pictures.frames.empty()) return fail("the simulation has no frames", sim);
  return pictures;
}

}  // namespace barehand::virtual_openni
