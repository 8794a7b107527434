#include "app/file_sinks.h"

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

}  // namespace barehand
