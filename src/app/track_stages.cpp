#include "app/track_stages.h"

#include "stages/preprocess/preprocess.h"

namespace barehand {

TrackStages make_track_stages(const Config& config, std::shared_ptr<const HandProfile> profile,
                              const std::optional<HandPose>& initial, CommandedTracker::Inbox inbox, Workers& workers,
                              RepeatLog& log, NewParams* news) {
  auto preprocessor =
      std::make_shared<std::unique_ptr<Preprocessor>>(std::make_unique<Preprocessor>(config.preprocess));
  auto tracker = std::make_shared<CommandedTracker>(
      config.tracker, std::move(profile), static_cast<std::uint64_t>(config.run.seed), workers, std::move(inbox), log);
  if (initial) tracker->start_at(*initial);
  return {[preprocessor, news](const FramePtr& frame, const HandEstimate* hint) {
            if (const auto params = news ? news->preprocess.take() : std::nullopt)
              *preprocessor = std::make_unique<Preprocessor>(*params);
            return (*preprocessor)->process(frame, hint);
          },
          [tracker, news](const HandObservationPtr& observation) -> Result<HandEstimatePtr> {
            if (const auto params = news ? news->tracker.take() : std::nullopt) tracker->change(*params);
            return tracker->process(*observation);
          }};
}

}  // namespace barehand
