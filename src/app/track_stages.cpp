#include "app/track_stages.h"

#include "stages/preprocess/preprocess.h"

namespace barehand {

TrackStages make_track_stages(const Config& config, std::shared_ptr<const HandProfile> profile,
                              const std::optional<HandPose>& initial, CommandedTracker::Inbox inbox, Workers& workers,
                              RepeatLog& log) {
  auto preprocessor = std::make_shared<Preprocessor>(config.preprocess);
  auto tracker = std::make_shared<CommandedTracker>(
      config.tracker, std::move(profile), static_cast<std::uint64_t>(config.run.seed), workers, std::move(inbox), log);
  if (initial) tracker->start_at(*initial);
  return {
      [preprocessor](const FramePtr& frame, const HandEstimate* hint) { return preprocessor->process(frame, hint); },
      [tracker](const HandObservationPtr& observation) -> Result<HandEstimatePtr> {
        return tracker->process(*observation);
      }};
}

}  // namespace barehand
