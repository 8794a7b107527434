#pragma once

#include <functional>

#include "app/shared/exit_code.h"
#include "app/track/live_page.h"
#include "app/track/track_options.h"
#include "io/web/view_scan.h"
#include "pipeline/config.h"
#include "pipeline/pipeline.h"
#include "pipeline/progress.h"
#include "pipeline/sink.h"

namespace barehand {

/// Why nothing was tracked.
struct TrackFailure {
  Error error;
  int exit_code;  ///< exit_code.h
};

/// How a run went.
struct TrackOutcome {
  PipelineHealth health;
  std::vector<StatusCounts> status;  ///< one a hand
  double seconds = 0;                ///< wall clock
  bool stopped = false;              ///< by a signal; everything tracked until then is written
  int exit_code = kExitOk;
  std::unique_ptr<LivePage> page;  ///< still served; null: nobody wants it, or it could not be
};

/// Tracks as `config` and the rest of `options` say; its config, seed and print_config are not looked at. Progress and
/// log on standard error, nothing on standard output. All input is checked before the first output file is touched.
/// `reread`: the configuration as it is now, asked for at SIGHUP by a run over live frames. Without it, and over a
/// recording, SIGHUP ends the run as SIGTERM does.
/// `more`: sinks besides those of the options. `scan`: what the live page says of a scan, asked on the thread of the
/// sinks; empty: no hand is being scanned.
tl::expected<TrackOutcome, TrackFailure> track(const TrackOptions& options, const Config& config,
                                               std::function<Result<Config>()> reread = {},
                                               std::vector<std::unique_ptr<Sink>> more = {},
                                               std::function<ViewScan()> scan = {});

/// Runs `barehand track` and returns its exit code (exit_code.h). Errors are told on standard error, the closing
/// summary on standard output.
int run_track(const TrackOptions& options);

}  // namespace barehand
