#include "app/file_sinks.h"

#include "io/hand_json.h"

namespace barehand {

Result<std::unique_ptr<Sink>> ResultTableSink::create(const std::string& path) {
  auto writer = TableWriter::create(path);
  if (!writer) return tl::unexpected(writer.error());
  return std::unique_ptr<Sink>(new ResultTableSink(std::move(*writer)));
}

Result<std::unique_ptr<Sink>> OverlaySink::create(const std::string& path, double fps, int every) {
  auto writer = OverlayWriter::open(path, fps / every);
  if (!writer) return tl::unexpected(writer.error());
  return std::unique_ptr<Sink>(new OverlaySink(std::move(*writer), every));
}

Result<void> SaveHandSink::finish() {
  if (!profile_) return fail("no hand was tracked, nothing to save", path_, "hold the open hand before the sensor");
  return save_profile(*profile_, path_);
}

}  // namespace barehand
