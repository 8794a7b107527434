#pragma once

#include "app/shared/outputs.h"
#include "app/track/track_options.h"
#include "tracking/two_hand_tracker.h"

namespace barehand {

/// Checks all outputs, with those of a second hand, by check_outputs, and returns `options` with their final names. A
/// live run does not fail because a file exists, since a service is restarted with the same arguments: without
/// --overwrite, a name that is taken gets the first free number (states.lcmlog becomes states-2.lcmlog). `config_path`:
/// the configuration's file; "": none.
Result<TrackOptions> resolve_outputs(TrackOptions options, const std::string& config_path,
                                     const TwoHandTracker::Profiles& hands, bool live);

/// Whether one of the outputs goes to the standard output. Call it before they are written.
bool writes_to_standard_output(const TrackOptions& options);

}  // namespace barehand
