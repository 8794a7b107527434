// Builds the stages that find and track hands from the configuration.
#include "pipeline/track_stages.h"

#include <algorithm>

#include "io/data_files.h"
#include "pipeline/object_feedback.h"
#include "stages/contact/contact_stage.h"
#include "stages/detection/detection_stage.h"
#include "stages/grasp/grasp_stage.h"
#include "stages/known_object/known_object_stage.h"
#include "stages/preprocess/preprocess.h"

namespace barehand {
namespace {

/// A file or folder that a configuration names: a name without a slash means one in configs/.
std::string path_in_configs(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  return find_data_file("configs/" + name).value_or(name);
}

/// The stage that recognises grasps; none, with a warning, if its classifier cannot be used.
std::shared_ptr<GraspStage> make_grasp_stage(const GraspParams& params, RepeatLog& log) {
  auto classifier = GraspClassifier::load(path_in_configs(params.classifier));
  if (classifier) return std::make_shared<GraspStage>(std::move(*classifier));
  log.logger().warn("grasps are not recognised: {}", classifier.error().message());
  return nullptr;
}

std::shared_ptr<ContactStage> make_contact_stage(const ContactParams& params,
                                                 const std::vector<KnownObjectPtr>& objects) {
  if (objects.empty()) return std::make_shared<ContactStage>(params);
  KnownObjectFinder find = std::bind_front(&KnownObjectStage::process, std::make_shared<KnownObjectStage>(objects));
  return std::make_shared<ContactStage>(params, std::move(find));
}

}  // namespace

TrackStages make_track_stages(const Config& config, const TwoHandTracker::Profiles& profiles,
                              const std::optional<HandPose>& initial, CommandedTracker::Inbox inbox, Workers& workers,
                              RepeatLog& log, PendingParams* pending, const std::vector<KnownObjectPtr>& objects,
                              ObjectWatcher watch_objects) {
  // Make the stages; they are shared, since the functions below keep them alive.
  const int hands = static_cast<int>(profiles.size());
  auto preprocessor =
      std::make_shared<std::unique_ptr<Preprocessor>>(std::make_unique<Preprocessor>(config.preprocess, hands));
  const auto only = hands == 1 ? std::optional(profiles[0]->handedness) : std::nullopt;
  auto detection = std::make_shared<DetectionStage>(config.detection, path_in_configs(config.detection.networks),
                                                    workers, log.shared_logger(), only);

  // Make the tracker, which starts at the given pose if there is one.
  auto tracker =
      std::make_shared<CommandedTracker>(config.tracker, profiles, static_cast<std::uint64_t>(config.run.seed), workers,
                                         std::move(inbox), log, pending ? &pending->tracker : nullptr);
  if (initial) tracker->start_at(*initial);

  // The tracker gets back the objects that are found near the hands, if it couples hands with them. A reload does not
  // change this. They are found with the contacts, which need not be published.
  TrackStages stages;
  const RefinementParams& refinement = config.tracker.refinement;
  const bool coupled = refinement.enabled && refinement.objects.enabled;
  const bool published = config.contact.enabled || !objects.empty();
  const auto feedback = coupled ? std::make_shared<ObjectFeedback>() : nullptr;
  if (coupled || published)
    stages.contact = [contact = make_contact_stage(config.contact, objects), watch = std::move(watch_objects), feedback,
                      published, places = ObjectPlaces()](const HandObservations& observations,
                                                          const HandEstimates& estimates) mutable {
      ObjectFeedback::Posting posting{feedback.get()};
      auto contacts = contact->process(observations, estimates);
      if (watch) watch(contact->objects());
      if (feedback) posting.objects = places.place(contact->shaped_objects(), estimates);
      if (contacts && !published) contacts->reset();
      return contacts;
    };

  // Grasps are classified if their classifier can be loaded.
  if (config.grasp.enabled)
    if (const auto grasp = make_grasp_stage(config.grasp, log))
      stages.grasp = std::bind_front(&GraspStage::process, grasp);

  // Preprocessing follows detection, and takes over parameters that have changed.
  stages.preprocess = [preprocessor, detection, hands, pending, told = false, logger = log.shared_logger()](
                          const FramePtr& frame, const HandEstimates& feedback) mutable {
    if (const auto params = pending ? pending->preprocess.take() : std::nullopt)
      *preprocessor = std::make_unique<Preprocessor>(*params, hands);
    Preprocessor& preprocess = **preprocessor;
    auto observations = preprocess.process(
        frame, feedback, detection->process(frame, feedback, preprocess.needs_labels(), preprocess.skin()));

    // Say once that a hand is followed without its colour, since the sender may have exchanged red and blue.
    const auto followed = [](const HandObservationPtr& hand) { return hand->followed; };
    if (!told && !preprocess.colour_is_trusted() && observations && std::ranges::any_of(*observations, followed)) {
      told = true;
      logger->warn(
          "colour is not used: the tracked hand does not have the colour of skin (a glove, coloured light, or red and "
          "blue exchanged)");
    }
    return observations;
  };
  stages.track = [tracker, feedback](HandObservations& observations) {
    if (feedback) tracker->couple_with(feedback->wait());
    auto estimates = tracker->process(observations);
    if (feedback) feedback->next();
    return estimates;
  };
  return stages;
}

}  // namespace barehand
