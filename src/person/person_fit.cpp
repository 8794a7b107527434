// Adapts a mean hand to the tracked person.
#include "person/person_fit.h"

namespace barehand {

PersonFit::PersonFit(const ShapeFitParams& params, std::shared_ptr<const HandProfile> mean)
    : params_(params), mean_(mean), profile_(std::move(mean)), fit_(params), next_skin_(params.first_rebuild) {}

// Counts a frame, and returns whether it should contribute to the person's hand shape. The first contributions change
// the shape most; later ones only follow slow changes, so they are less frequent.
bool PersonFit::due() {
  const int every = fit_.frames() < params_.initial_frames ? params_.every : params_.every_later;
  return frames_++ % every == 0;
}

PersonFit::Change PersonFit::add_frame(const HandObservation& observation, const HandPose& pose,
                                       const Refinement& refinement, const std::shared_ptr<const Skin>& skin) {
  if (!due()) return Change::none;

  // After a new skin was built, compute how it changes with the shape.
  if (!basis_) {
    made_skin_ = skin;
    made_shape_ = shape_;
    basis_ = shape_basis(*mean_, made_shape_, *made_skin_);
  }

  // Update the shape by the equations of this frame.
  refinement.shape_equations(observation, pose, *basis_, equations_);
  if (!fit_.add(equations_, shape_)) return Change::none;
  shape_ = fit_.estimate();
  profile_ = std::make_shared<const HandProfile>(reshaped(*mean_, shape_));

  // Have the skin rebuilt at doubling intervals; in between, change it to first order.
  if (fit_.frames() >= next_skin_) {
    next_skin_ *= 2;
    basis_.reset();
    return Change::large;
  }
  skin_ = std::make_shared<const Skin>(morphed(*made_skin_, *basis_, shape_ - made_shape_));
  return Change::small;
}

}  // namespace barehand
