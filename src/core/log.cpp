#include "core/log.h"

#include <spdlog/sinks/null_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

namespace barehand {

std::shared_ptr<spdlog::logger> make_logger() {
  auto logger = std::make_shared<spdlog::logger>("barehand", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("%^%l%$: %v");
  logger->flush_on(spdlog::level::info);
  return logger;
}

std::shared_ptr<spdlog::logger> make_silent_logger() {
  return std::make_shared<spdlog::logger>("silent", std::make_shared<spdlog::sinks::null_sink_mt>());
}

void RepeatLog::log(spdlog::level::level_enum level, const std::string& kind, const std::string& message) {
  const auto kept_back = filter_.admit(kind);
  if (!kept_back) return;
  if (*kept_back == 0) {
    logger_->log(level, message);
  } else {
    logger_->log(level, "{} (and {} more like this)", message, *kept_back);
  }
}

}  // namespace barehand
