#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <string>

#include "core/repeat_filter.h"

namespace barehand {

/// Returns the run's logger. It writes to standard error, because standard output is reserved for results. If systemd
/// has connected standard error to the journal, messages go there in the journal's native format, with priorities.
std::shared_ptr<spdlog::logger> make_logger();
/// Returns a logger that discards all messages.
std::shared_ptr<spdlog::logger> make_silent_logger();

/// A logger that suppresses repeated messages (see RepeatFilter).
class RepeatLog {
 public:
  RepeatLog(std::shared_ptr<spdlog::logger> logger, const Clock& clock, std::int64_t interval_us = 1'000'000,
            int growth = 1)
      : logger_(std::move(logger)), filter_(clock, interval_us, growth) {}
  void log(spdlog::level::level_enum level, const std::string& kind, const std::string& message);
  void warn(const std::string& kind, const std::string& message) { log(spdlog::level::warn, kind, message); }
  spdlog::logger& logger() { return *logger_; }
  const std::shared_ptr<spdlog::logger>& shared_logger() const { return logger_; }

 private:
  std::shared_ptr<spdlog::logger> logger_;
  RepeatFilter filter_;
};

}  // namespace barehand
