#pragma once

#include <memory>

#include "core/parallel/parallel.h"
#include "stages/fusion/fusion.h"
#include "stages/segment_tracker/segment_tracker.h"
#include "tracking/tracker_params.h"

namespace barehand {

/// One person's hand and the parts of the tracker that are made for it. Another hand is another model.
struct HandModel {
  /// `workers` outlives it; `observer` compares samples with the data, as it did for the model before; none: the CPU.
  HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, Workers& workers,
            std::shared_ptr<Observer> observer);
  /// The same with a skin and a search that are there already; the search may be that of a similar hand.
  HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::shared_ptr<const Skin> skin,
            std::shared_ptr<Initialiser> initialiser, Workers& workers, std::shared_ptr<Observer> observer);

  std::shared_ptr<const HandProfile> profile;
  std::shared_ptr<const Skin> skin;
  std::shared_ptr<const HandSurface> surface;  ///< of the local trackers
  SegmentTracker segment_tracker;
  Fusion fusion;
  Refinement refinement;
  std::shared_ptr<Initialiser> initialiser;
};

}  // namespace barehand
