#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/log.h"
#include "core/parallel/parallel.h"
#include "object/known_object.h"
#include "stages/segment_tracker/make_observer.h"
#include "stages/segment_tracker/segment_tracker.h"
#include "tracking/tracker_params.h"

namespace barehand {

/// Data that all parts of one tracker use. The tracker owns it, and its parts only read it.
struct TrackerContext {
  TrackerParams params;
  std::uint64_t seed;                   ///< seeds all random numbers, together with the number of the frame
  Workers& workers;                     ///< must outlive the tracker
  std::shared_ptr<spdlog::logger> log;  ///< for messages to the user
  std::shared_ptr<Observer> observer;   ///< compares samples with the data; kept from model to model, may be a GPU

  std::vector<NearbyObject> objects = {};  ///< objects near this hand, as they were a few frames ago

  /// The observer for other parameters: the present one, unless they ask for another observer.
  std::shared_ptr<Observer> observer_for(const TrackerParams& other) const {
    if (same_observer(params.segment_tracker, other.segment_tracker)) return observer;
    return make_observer(other.segment_tracker, workers, log);
  }

  /// Keeps those of the `nearby` objects that no other hand than `hand_id` holds; none if they are switched off.
  void couple_with(std::span<const NearbyObject> nearby, std::int32_t hand_id) {
    objects.clear();
    if (!params.refinement.objects.enabled) return;
    const auto of_other = [&](std::int32_t id) { return id >= 0 && id != hand_id; };
    for (const NearbyObject& object : nearby)
      if (!of_other(object.hand_id) && !of_other(object.holder_id)) objects.push_back(object);
  }
};

}  // namespace barehand
