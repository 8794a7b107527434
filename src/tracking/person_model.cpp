// Learns the tracked person's hand: fits its shape, scans its skin and checks its size.
#include "tracking/person_model.h"

#include <utility>

namespace barehand {
namespace {

std::shared_ptr<const Skin> skin_of(const HandProfile& profile, const TrackerParams& params) {
  return std::make_shared<const Skin>(make_skin(profile, params.skin_cell));
}

}  // namespace

PersonModel::PersonModel(const TrackerContext& context, std::shared_ptr<const HandProfile> given,
                         std::shared_ptr<const Skin> skin)
    : context_(context),
      given_(std::move(given)),
      given_skin_(skin ? std::move(skin) : skin_of(*given_, context.params)),
      model_(model_of(given_, given_skin_)) {
  start_learning();
}

std::unique_ptr<HandModel> PersonModel::model_of(std::shared_ptr<const HandProfile> profile,
                                                 std::shared_ptr<const Skin> skin) const {
  return std::make_unique<HandModel>(context_.params, std::move(profile), std::move(skin), context_.workers,
                                     context_.observer);
}

void PersonModel::start_learning() {
  stop_fit_.request_stop();
  stop_fit_ = {};
  fit_.reset();
  size_verifier_.reset();
  size_in_view_ = 1;
  size_reported_ = false;
  const TrackerParams& params = context_.params;
  const bool learns = params.shape_fit.enabled, of_mean = given_->origin == ProfileOrigin::mean;
  if (learns && !given_->scanned_skin)
    scan_ = std::make_unique<PersonScan>(PersonScanParams{params.refinement, params.shape_fit, params.skin_cell},
                                         given_, context_.workers);
  if (learns && of_mean)
    fit_.emplace(params.shape_fit, given_, given_skin_, params.skin_cell, context_.workers, stop_fit_.get_token());
  if (!of_mean) expect_any_size();
}

void PersonModel::expect_any_size() {
  if (context_.params.size_check) size_verifier_.emplace(context_.params.refinement, model_->profile, model_->skin);
}

void PersonModel::reset() {
  if (model_->profile != given_) model_ = model_of(given_, given_skin_);
  start_learning();
}

void PersonModel::use(std::shared_ptr<const HandProfile> given) {
  given_ = std::move(given);
  given_skin_ = skin_of(*given_, context_.params);
  model_ = model_of(given_, given_skin_);
  scan_.reset();
  reset();
}

void PersonModel::change(const TrackerParams& params, std::shared_ptr<Observer> observer) {
  // Make everything before anything changes.
  std::shared_ptr<const Skin> given_skin = given_skin_, skin = skin_of(*model_->profile, params);
  if (params.skin_cell != context_.params.skin_cell) given_skin = skin_of(*given_, params);
  auto model = std::make_unique<HandModel>(params, model_->profile, skin, context_.workers, std::move(observer));

  given_skin_ = std::move(given_skin);
  model_ = std::move(model);
  if (fit_) fit_->use_skin(std::move(skin), params.skin_cell);
  if (size_verifier_) size_verifier_.emplace(params.refinement, model_->profile, model_->skin);
}

void PersonModel::start_track() {
  if (scan_) scan_->restart();
  const bool had_mismatch = std::exchange(size_in_view_, 1) != 1;
  if (had_mismatch || (fit_ && model_->profile->scanned_skin)) expect_any_size();
}

void PersonModel::learn(const HandObservation& observation, const RefinedPose& refined, bool good) {
  if (size_verifier_) check_size(observation, refined);
  if (!good) return;
  if (scan_) scan_->add(observation, refined.pose);
  if (fit_ && !model_->profile->scanned_skin) fit_bones(observation, refined.pose);
}

void PersonModel::check_size(const HandObservation& observation, const RefinedPose& refined) {
  if (size_in_view_ != 1) return;
  const auto size = size_verifier_->add_frame(observation, refined.pose, refined.score);
  if (!size) return;
  if (!fit_) return note_size_mismatch(*size);
  context_.log->info("the bone fit starts again with a hand of {:.2f} times the size of the last one", *size);
  reset();
}

void PersonModel::note_size_mismatch(double size) {
  size_in_view_ = size;
  if (!std::exchange(size_reported_, true)) context_.log->warn("{}", other_size(size, *model_->profile));
}

void PersonModel::fit_bones(const HandObservation& observation, const HandPose& pose) {
  const PersonFit::Change change = fit_->add_frame(observation, pose, model_->refinement);
  if (change == PersonFit::Change::large) {
    model_ = model_of(fit_->profile(), fit_->skin());
    context_.log->info(
        "hand fitted to the person after {} contributing frames: {:.0f} mm long, the mean hand {:.0f} mm",
        fit_->fit().frames(), 1e3 * fit_->profile()->hand_length(), 1e3 * given_->hand_length());
  } else if (change == PersonFit::Change::small) {
    model_ = std::make_unique<HandModel>(context_.params, fit_->profile(), fit_->skin(), model_->initialiser,
                                         context_.workers, context_.observer);
  }
}

void PersonModel::adopt_scan() {
  if (!scan_) return;
  try {
    const auto hand = scan_->take();
    if (!hand) return;
    model_ = std::make_unique<HandModel>(context_.params, hand, hand->scanned_skin, model_->initialiser,
                                         context_.workers, context_.observer);
    context_.log->info("hand scanned while tracked: {:.0f} mm long", 1e3 * hand->hand_length());
    if (fit_ && scan_->of_hand_before()) expect_any_size();
  } catch (const std::exception& e) {  // most likely out of memory: tracking continues with the present hand model
    context_.log->warn("the hand could not be scanned: {}", e.what());
  }
}

}  // namespace barehand
