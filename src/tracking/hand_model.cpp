// Builds the parts of the tracker that belong to one hand.
#include "tracking/hand_model.h"

namespace barehand {
namespace {

std::shared_ptr<const HandSurface> make_surface(const TrackerParams& params, const HandProfile& profile,
                                                const Skin& skin) {
  return std::make_shared<const HandSurface>(params.skin == "cylinders"
                                                 ? make_cylinder_surface(profile, params.skin_points)
                                                 : surface_points(skin, profile, params.skin_points));
}

}  // namespace

HandModel::HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> person, Workers& workers,
                     std::shared_ptr<Observer> observer)
    : HandModel(params, person, std::make_shared<const Skin>(make_skin(*person, params.skin_cell)), workers,
                std::move(observer)) {}

HandModel::HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> person,
                     std::shared_ptr<const Skin> its_skin, Workers& workers, std::shared_ptr<Observer> observer)
    : HandModel(params, person, its_skin, std::make_shared<Initialiser>(person, *its_skin, params.initialiser), workers,
                std::move(observer)) {}

HandModel::HandModel(const TrackerParams& params, std::shared_ptr<const HandProfile> person,
                     std::shared_ptr<const Skin> its_skin, std::shared_ptr<Initialiser> search, Workers& workers,
                     std::shared_ptr<Observer> observer)
    : profile(std::move(person)),
      skin(std::move(its_skin)),
      surface(make_surface(params, *profile, *skin)),
      segment_tracker(params.segment_tracker, surface, workers, std::move(observer)),
      fusion(params.fusion, profile, workers),
      refinement(params.refinement, profile, skin),
      initialiser(std::move(search)) {}

}  // namespace barehand
