#pragma once

#include <string>
#include <vector>

#include "core/slot.h"
#include "pipeline/config.h"

namespace barehand {

/// Mailboxes for new parameters. Each stage or sink takes the parameters from its own mailbox between two frames.
struct PendingParams {
  Slot<PreprocessParams> preprocess;
  Slot<TrackerParams> tracker;
  Slot<PublishParams> bus, states_log, mcap, view, progress;
};

/// Changes the configuration of a running pipeline.
class Reload {
 public:
  /// `in_force`: the configuration that the run was started with. `out` must outlive this object.
  Reload(Config in_force, PendingParams& out) : in_force_(std::move(in_force)), out_(out) {}

  /// What changed: one text per value, such as "tracker.ambiguity_margin: 0.15 -> 0.2".
  struct Changes {
    std::vector<std::string> made;
    std::vector<std::string> for_restart;  ///< cannot change while running; the old values stay in force
  };
  /// Puts changed groups of `wanted`, which must be a valid configuration, into the mailboxes. Call from one thread
  /// only.
  Changes apply(const Config& wanted);

 private:
  Config in_force_;
  PendingParams& out_;
};

}  // namespace barehand
