#pragma once

#include <vector>

#include "observe/observation.h"
#include "observe/surface_point.h"
#include "stages/known_object/known_object_tracker.h"

namespace barehand {

/// Finds and tracks the objects whose meshes are known, among the surfaces near the hands, frame after frame in
/// order.
class KnownObjectStage {
 public:
  explicit KnownObjectStage(const std::vector<KnownObjectPtr>& objects);

  /// `points`: of all objects near the hands; those of a known object get its id. `objects`: all objects near the
  /// hands; those that are known objects are replaced by them. Returns the known objects that are seen.
  std::vector<PosedObject> process(const HandObservations& observations, const HandEstimates& estimates,
                                   std::vector<SurfacePoint>& points, FrameVector<ObjectEstimate>& objects);

 private:
  void collect_free(const std::vector<SurfacePoint>& points);

  std::vector<KnownObjectTracker> trackers_;
  std::vector<Eigen::Vector3f> free_;  // points that no known object has claimed
};

}  // namespace barehand
