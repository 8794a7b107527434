#pragma once

#include <spdlog/logger.h>

#include <memory>

#include "app/track/track_options.h"
#include "core/clock.h"
#include "io/web/view_server.h"

namespace barehand {

/// The live page of a run with the recorder that its button starts and stops. It may outlive the run.
class LivePage {
 public:
  /// Checks the page's settings in `options`. Errors: an invalid address, a folder that does not exist.
  static Result<void> check(const TrackOptions& options);
  /// Opens the page according to `options`, which must ask for one. Errors: the port is taken, the page's files are
  /// missing.
  static Result<std::unique_ptr<LivePage>> open(const TrackOptions& options, std::shared_ptr<spdlog::logger> log);

  ViewServer& server() { return *server_; }
  LogRecorder* recorder() { return recorder_.get(); }  ///< the recorder; null: nothing can be recorded

 private:
  LivePage() = default;
  const SystemClock clock_;
  std::unique_ptr<LogRecorder> recorder_;
  std::unique_ptr<ViewServer> server_;
};

}  // namespace barehand
