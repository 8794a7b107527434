#pragma once

#include "app/shared/outputs.h"
#include "app/track/track_options.h"
#include "tracking/two_hand_tracker.h"

namespace barehand {

/// The outputs that `options` names, with those of the second hand, after check_outputs. A live run is not refused
/// because of files that exist: a service starts again with the same arguments. There, without --overwrite, a taken
/// name gets the first free number: states.lcmlog becomes states-2.lcmlog. `config_path`: the configuration's file, "":
/// none.
Result<TrackOptions> settle_outputs(TrackOptions options, const std::string& config_path,
                                    const TwoHandTracker::Profiles& hands, bool live);

/// Whether one of the outputs goes to the standard output. To be asked before they are written.
bool writes_to_standard_output(const TrackOptions& options);

}  // namespace barehand
