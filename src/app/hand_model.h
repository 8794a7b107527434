#pragma once

#include <memory>

#include "app/tracker_params.h"
#include "core/log.h"
#include "core/parallel.h"
#include "stages/fusion/fusion.h"
#include "stages/segment_tracker/segment_tracker.h"

namespace barehand {

/// One person's hand and the parts of the tracker that are made for it. Another hand is another model.
struct HandModel {
  /// `workers` outlives it; `log` hears what compares samples with the data, and when that is lost.
  HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, Workers& workers,
            std::shared_ptr<spdlog::logger> log);
  /// The same with a skin and a search that are there already; the search may be that of a similar hand.
  HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::shared_ptr<const Skin> skin,
            std::shared_ptr<Initialiser> initialiser, Workers& workers, std::shared_ptr<spdlog::logger> log);

  std::shared_ptr<const HandProfile> profile;
  std::shared_ptr<const Skin> skin;
  std::shared_ptr<const HandSurface> surface;  ///< of the local trackers
  SegmentTracker segment_tracker;
  Fusion fusion;
  Refinement refinement;
  std::shared_ptr<Initialiser> initialiser;
};

}  // namespace barehand
