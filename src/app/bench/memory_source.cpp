// Plays frames that were read into memory before, so that `barehand bench` measures tracking alone.
#include "app/bench/memory_source.h"

#include <cassert>
#include <thread>

namespace barehand {
namespace {

template <class T>
Image<T> every_nth(const Image<T>& image, int n) {
  Image<T> out(image.width() / n, image.height() / n);
  for (int v = 0; v < out.height(); ++v)
    for (int u = 0; u < out.width(); ++u) out.at(u, v) = image.at(u * n, v * n);
  return out;
}

FramePtr decimated(const RgbdFrame& frame, int factor) {
  RgbdFrame small;
  small.utime = frame.utime;
  small.number = frame.number;
  small.sensor = frame.sensor;
  small.depth_unit = frame.depth_unit;
  small.depth = every_nth(frame.depth, factor);
  small.colour = every_nth(frame.colour, factor);
  const Intrinsics& c = frame.camera;
  small.camera = {small.depth.width(), small.depth.height(), c.fx / factor,
                  c.fy / factor,       c.cx / factor,        c.cy / factor};
  return std::make_shared<const RgbdFrame>(std::move(small));
}

}  // namespace

std::int64_t FrameStore::bytes() const {
  std::int64_t sum = 0;
  for (const FramePtr& f : frames)
    sum += static_cast<std::int64_t>(f->depth.size() * sizeof(std::uint16_t) + f->colour.size() * sizeof(Rgb));
  return sum;
}

Result<FrameStore> read_frames(FrameSource& source, std::int64_t count) {
  FrameStore store;
  while (static_cast<std::int64_t>(store.frames.size()) < count) {
    SourceEvent event = source.next(std::chrono::milliseconds(1000));
    if (auto* frame = std::get_if<FramePtr>(&event)) store.frames.push_back(std::move(*frame));
    if (auto* failed = std::get_if<SourceFailed>(&event)) return tl::unexpected(failed->error);
    if (std::holds_alternative<EndOfStream>(event)) break;
  }
  if (store.frames.empty()) return fail("no frames", source.name(), "choose a source with frames");
  return store;
}

FrameStore decimated(const FrameStore& store, int factor) {
  assert(factor > 0);
  if (factor == 1) return store;
  FrameStore small;
  for (const FramePtr& f : store.frames) small.frames.push_back(decimated(*f, factor));
  return small;
}

MemorySource::MemorySource(const FrameStore& store, Options options, const Clock& clock)
    : store_(store), options_(options), clock_(clock) {
  assert(!store.frames.empty());
}

const FramePtr& MemorySource::stored(std::int64_t index) const {
  const auto n = static_cast<std::int64_t>(store_.frames.size());
  if (n == 1) return store_.frames[0];
  const std::int64_t place = index % (2 * n - 2);  // plays 0 ... n-1 forwards, then n-2 ... 1 backwards
  return store_.frames[place < n ? place : 2 * n - 2 - place];
}

SourceEvent MemorySource::next(std::chrono::milliseconds patience) {
  if (delivered_ == options_.count) return EndOfStream{};
  if (options_.rate) return when_due(patience);
  return stored(delivered_++);
}

SourceEvent MemorySource::when_due(std::chrono::milliseconds patience) {
  if (!start_us_) start_us_ = clock_.steady_us();
  const auto due_us = *start_us_ + static_cast<std::int64_t>(static_cast<double>(delivered_) * 1e6 / *options_.rate);
  const std::int64_t wait_us = due_us - clock_.steady_us();
  if (wait_us > patience.count() * 1000) {
    std::this_thread::sleep_for(patience);
    return Timeout{};
  }
  if (wait_us > 0) std::this_thread::sleep_for(std::chrono::microseconds(wait_us));
  auto frame = std::make_shared<RgbdFrame>(*stored(delivered_));
  frame->utime = clock_.utime() + std::min<std::int64_t>(due_us - clock_.steady_us(), 0);
  frame->number = delivered_++;
  return FramePtr(std::move(frame));
}

}  // namespace barehand
