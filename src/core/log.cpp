// Creates the program's logger, for a terminal or for systemd's journal.
#include "core/log.h"

#include <spdlog/sinks/null_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/systemd_sink.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

namespace barehand {
namespace {

/// Whether standard error goes to systemd's journal. JOURNAL_STREAM identifies the journal's stream by device and
/// inode; it must be compared because standard error may have been redirected since systemd set the variable.
bool journal_listens() {
  const char* stream = std::getenv("JOURNAL_STREAM");
  struct stat error_output {};
  return stream != nullptr && fstat(STDERR_FILENO, &error_output) == 0 &&
         stream == std::to_string(error_output.st_dev) + ":" + std::to_string(error_output.st_ino);
}

}  // namespace

std::shared_ptr<spdlog::logger> make_logger() {
  if (journal_listens())
    return std::make_shared<spdlog::logger>("barehand", std::make_shared<spdlog::sinks::systemd_sink_mt>("barehand"));
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
