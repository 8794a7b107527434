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
#include "pipeline/track_stages.h"

namespace barehand {

// The run of `barehand track`.

/// Why nothing was tracked.
struct TrackFailure {
  Error error;
  int exit_code;  ///< exit_code.h
};

/// The result of a run.
struct TrackOutcome {
  PipelineHealth health;
  std::vector<StatusCounts> status;  ///< one for each hand
  double seconds = 0;                ///< duration of the run [s]
  bool stopped = false;              ///< whether a signal ended the run; everything tracked before is written
  int exit_code = kExitOk;
  std::unique_ptr<LivePage>
      page;  ///< the page, whose server still runs; null: not requested, or it could not be started
};

/// Tracks with `config` and `options`. Of the latter, seed and print_config are not used, and config only to protect
/// its file from the outputs. Progress and log go to standard error, nothing to standard output. All input is checked
/// before the first output file is touched. `reread` returns the configuration as it is now; a run over live frames
/// calls it at SIGHUP. Without it, and over a recording, SIGHUP ends the run as SIGTERM does. `more`: sinks in addition
/// to those of the options. `scan` returns what the live page shows of a scan; it is called on the thread of the sinks;
/// empty: no hand is being scanned. `watch_objects`: as make_track_stages() takes it.
tl::expected<TrackOutcome, TrackFailure> track(const TrackOptions& options, const Config& config,
                                               std::function<Result<Config>()> reread = {},
                                               std::vector<std::unique_ptr<Sink>> more = {},
                                               std::function<ViewScan()> scan = {}, ObjectWatcher watch_objects = {});

/// Runs `barehand track` and returns its exit code (exit_code.h). Errors are printed to standard error; so is the final
/// summary if an output goes to standard output, where it is printed otherwise.
int run_track(const TrackOptions& options);

}  // namespace barehand
