#include "app/track_stages.h"

namespace barehand {

Result<TrackStages> make_track_stages(const Config&, std::shared_ptr<const HandProfile>, const std::optional<HandPose>&,
                                      Workers&) {
  return fail("this build has no tracker");
}

}  // namespace barehand
