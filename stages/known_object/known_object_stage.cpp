#include "stages/known_object/known_object_stage.h"

#include <algorithm>
#include <map>

namespace barehand {
namespace {

constexpr float kOwn = 0.008f;      // points this near to the surface of a known object are its own [m]
constexpr double kMostlyOwn = 0.5;  // fraction of its points that makes an object the known one

}  // namespace

KnownObjectStage::KnownObjectStage(const std::vector<KnownObjectPtr>& objects) {
  for (const KnownObjectPtr& object : objects) trackers_.emplace_back(object);
}

/// Collects the points that are seen and that no known object has claimed.
void KnownObjectStage::collect_free(const std::vector<SurfacePoint>& points) {
  free_.clear();
  for (const SurfacePoint& point : points)
    if (point.component >= 0 &&
        std::ranges::none_of(trackers_, [&](const auto& t) { return t.object()->id == point.object; }))
      free_.push_back(point.p);
}

std::vector<PosedObject> KnownObjectStage::process(const HandObservations& observations, const HandEstimates& estimates,
                                                   std::vector<SurfacePoint>& points,
                                                   FrameVector<ObjectEstimate>& objects) {
  std::vector<PosedObject> posed;
  if (observations.empty() || !observations.front()->frame) return posed;
  const ObservedDepth view(observations);

  // Count the points of each object, to know later which share of them a known object claimed.
  std::map<std::int32_t, std::pair<std::size_t, std::size_t>> claimed;  // by object id: points, and claimed ones
  for (const SurfacePoint& point : points) ++claimed[point.object].first;

  // Track the objects one after the other; a point that one claims is not available to the others.
  FrameVector<ObjectEstimate> known;
  for (KnownObjectTracker& tracker : trackers_) {
    collect_free(points);
    const auto seen = tracker.process(observations.front()->frame->utime, view, estimates, free_);
    if (!seen) continue;
    known.push_back(*seen);
    posed.push_back({tracker.object(), seen->T_camera_object, seen->covariance, seen->hand_id});

    // Claim the points near the surface of the object.
    const SE3 T_object_camera = seen->T_camera_object.inverse();
    for (SurfacePoint& point : points) {
      const Eigen::Vector3f p = (T_object_camera * point.p.cast<double>()).cast<float>();
      if (std::abs(tracker.object()->grid.distance(p)) > kOwn) continue;
      ++claimed[point.object].second;
      point.object = seen->id;
    }
  }

  // Replace the unknown objects most of whose points were claimed.
  std::erase_if(objects, [&](const ObjectEstimate& estimate) {
    const auto& [all, own] = claimed[estimate.id];
    return static_cast<double>(own) > kMostlyOwn * static_cast<double>(all);
  });
  objects.insert(objects.begin(), known.begin(), known.end());
  return posed;
}

}  // namespace barehand
