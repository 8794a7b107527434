// Adapts a mean hand to the tracked person.
#include "person/person_fit.h"

#include "core/parallel/is_ready.h"

namespace barehand {

PersonFit::PersonFit(const ShapeFitParams& params, std::shared_ptr<const HandProfile> mean,
                     std::shared_ptr<const Skin> skin, double skin_cell, Workers& workers, std::stop_token stop)
    : params_(params),
      skin_cell_(skin_cell),
      workers_(workers),
      stop_(std::move(stop)),
      mean_(mean),
      profile_(std::move(mean)),
      skin_(std::move(skin)),
      fit_(params),
      next_skin_(params.first_rebuild) {}

// Counts a frame, and returns whether it should contribute to the person's hand shape. The first contributions change
// the shape most; later ones only follow slow changes, so they are less frequent.
bool PersonFit::due() {
  const int every = fit_.frames() < params_.initial_frames ? params_.every : params_.every_later;
  return frames_++ % every == 0;
}

void PersonFit::build(std::shared_ptr<const Skin> skin) {
  building_ = workers_.run_in_background(
      [mean = mean_, shape = shape_, skin = std::move(skin), cell = skin_cell_, stop = stop_](Workers&) mutable {
        if (!skin) skin = std::make_shared<const Skin>(make_skin(reshaped(*mean, shape), cell, stop));
        return BuiltSkin{shape, skin, shape_basis(*mean, shape, *skin, stop)};
      });
}

bool PersonFit::take_built() {
  if (!is_ready(building_)) return false;
  built_ = building_.get();
  const auto before = std::exchange(skin_, skin_of_shape());
  return skin_ != before;
}

std::shared_ptr<const Skin> PersonFit::skin_of_shape() const {
  if (shape_ == built_->shape) return built_->skin;
  return std::make_shared<const Skin>(morphed(*built_->skin, built_->basis, shape_ - built_->shape));
}

PersonFit::Change PersonFit::add_frame(const HandObservation& observation, const HandPose& pose,
                                       const Refinement& refinement) {
  if (!due()) return Change::none;
  if (!built_ && !building_.valid()) build(skin_);
  if (take_built()) return Change::large;
  if (!built_) return Change::none;

  // Update the shape by the equations of this frame.
  refinement.shape_equations(observation, pose, built_->basis, equations_);
  if (!fit_.add(equations_, shape_)) return Change::none;
  shape_ = fit_.estimate();
  profile_ = std::make_shared<const HandProfile>(reshaped(*mean_, shape_));

  // Have the skin built anew at doubling intervals; until then, change it to first order.
  if (fit_.frames() >= next_skin_ && !building_.valid()) {
    next_skin_ *= 2;
    build(nullptr);
    if (take_built()) return Change::large;
  }
  skin_ = skin_of_shape();
  return Change::small;
}

void PersonFit::use_skin(std::shared_ptr<const Skin> skin, double skin_cell) {
  skin_ = std::move(skin);
  skin_cell_ = skin_cell;
  built_.reset();
  building_ = {};
}

}  // namespace barehand
