// Builds the stages that find and track hands from the configuration.
#include "pipeline/track_stages.h"

#include "io/data_files.h"
#include "stages/contact/contact_stage.h"
#include "stages/detection/detection_stage.h"
#include "stages/known_object/known_object_stage.h"
#include "stages/preprocess/preprocess.h"

namespace barehand {
namespace {

/// The folder with the networks: a name without a slash means one of the folders in configs/.
std::string networks_folder(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  return find_data_file("configs/" + name).value_or(name);
}

std::shared_ptr<ContactStage> make_contact_stage(const ContactParams& params,
                                                 const std::vector<KnownObjectPtr>& objects) {
  if (objects.empty()) return std::make_shared<ContactStage>(params);
  KnownObjectFinder find = std::bind_front(&KnownObjectStage::process, std::make_shared<KnownObjectStage>(objects));
  return std::make_shared<ContactStage>(params, std::move(find), static_cast<int>(objects.size()));
}

}  // namespace

TrackStages make_track_stages(const Config& config, const TwoHandTracker::Profiles& profiles,
                              const std::optional<HandPose>& initial, CommandedTracker::Inbox inbox, Workers& workers,
                              RepeatLog& log, PendingParams* pending, const std::vector<KnownObjectPtr>& objects) {
  const int hands = static_cast<int>(profiles.size());
  auto preprocessor =
      std::make_shared<std::unique_ptr<Preprocessor>>(std::make_unique<Preprocessor>(config.preprocess, hands));
  auto detection = std::make_shared<DetectionStage>(config.detection, networks_folder(config.detection.networks),
                                                    config.preprocess.use_colour, workers, log.shared_logger());
  auto tracker =
      std::make_shared<CommandedTracker>(config.tracker, profiles, static_cast<std::uint64_t>(config.run.seed), workers,
                                         std::move(inbox), log, pending ? &pending->tracker : nullptr);
  if (initial) tracker->start_at(*initial);
  TrackStages stages;
  if (config.contact.enabled || !objects.empty())
    stages.contact = std::bind_front(&ContactStage::process, make_contact_stage(config.contact, objects));
  stages.preprocess = [preprocessor, detection, hands, pending](const FramePtr& frame, const HandEstimates& feedback) {
    if (const auto params = pending ? pending->preprocess.take() : std::nullopt)
      *preprocessor = std::make_unique<Preprocessor>(*params, hands);
    return (*preprocessor)->process(frame, feedback, detection->process(*frame, feedback));
  };
  stages.track = std::bind_front(&CommandedTracker::process, tracker);
  return stages;
}

}  // namespace barehand
