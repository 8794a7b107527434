#pragma once

#include "app/track_options.h"

namespace barehand {

/// Runs `barehand track` and returns its exit code (exit_code.h). Errors are told on standard error, the closing
/// summary on standard output.
int run_track(const TrackOptions& options);

}  // namespace barehand
