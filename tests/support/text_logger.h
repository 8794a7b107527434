#pragma once

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <ostream>

namespace barehand::test {

/// A logger that writes its lines to `text`, which must outlive it.
inline std::shared_ptr<spdlog::logger> text_logger(std::ostream& text) {
  return std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text));
}

}  // namespace barehand::test
