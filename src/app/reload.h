#pragma once

#include <string>
#include <vector>

#include "app/config.h"
#include "core/slot.h"

namespace barehand {

/// Parameters that replace those in force, each taken by the one that works with them, between two frames.
struct NewParams {
  Slot<PreprocessParams> preprocess;
  Slot<TrackerParams> tracker;
  Slot<PublishParams> bus, states_log;
};

/// Exchanges the configuration of a run that goes on.
class Reload {
 public:
  /// `in_force`: what the run was started with. `out` outlives it.
  Reload(Config in_force, NewParams& out) : in_force_(std::move(in_force)), out_(out) {}

  /// Values as "tracker.doubt: 0.15 -> 0.2".
  struct Changes {
    std::vector<std::string> made;
    std::vector<std::string> for_restart;  ///< cannot change while running: the old ones stay
  };
  /// One thread. `wanted` has passed every check of a start.
  Changes apply(const Config& wanted);

 private:
  Config in_force_;
  NewParams& out_;
};

}  // namespace barehand
