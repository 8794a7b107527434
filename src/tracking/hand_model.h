#pragma once

#include <memory>

#include "core/parallel/parallel.h"
#include "stages/fusion/fusion.h"
#include "stages/segment_tracker/segment_tracker.h"
#include "tracking/tracker_params.h"

namespace barehand {

/// One person's hand, and the parts of the tracker that are built for this hand. Another hand needs another model.
struct HandModel {
  /// `observer` compares samples with the data and is passed on from model to model; null: the CPU does it. `workers`
  /// must outlive the model.
  HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, Workers& workers,
            std::shared_ptr<Observer> observer);
  /// Makes the model with an existing skin of the profile, which saves a tenth of a second.
  HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::shared_ptr<const Skin> skin,
            Workers& workers, std::shared_ptr<Observer> observer);
  /// Makes the model with an existing skin and an existing initialiser; the initialiser may be that of a similar hand.
  HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::shared_ptr<const Skin> skin,
            std::shared_ptr<Initialiser> initialiser, Workers& workers, std::shared_ptr<Observer> observer);

  std::shared_ptr<const HandProfile> profile;
  std::shared_ptr<const Skin> skin;
  std::shared_ptr<const HandSurface> surface;  ///< skin points that the local trackers compare with the data
  SegmentTracker segment_tracker;
  Fusion fusion;
  Refinement refinement;
  std::shared_ptr<Initialiser> initialiser;
};

}  // namespace barehand
