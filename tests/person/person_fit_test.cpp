#include "person/person_fit.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "support/painted_hand.h"
#include "tracking/hand_model.h"

namespace barehand {
namespace {

/// Fits a person whose hand is larger and broader, with longer fingers, than the mean hand, to frames of a few poses.
class PersonFitTest : public ::testing::Test {
 protected:
  static HandShape shape_of_the_person() {
    HandShape shape = HandShape::Zero();
    shape[0] = 0.08;
    for (int k = 0; k < kShapeCount; ++k) {
      const std::string& name = shape_parameters()[k].name;
      if (name == "fingers_thickness") shape[k] = 0.1;
      if (name == "index_length" || name == "middle_length") shape[k] = 0.04;
    }
    return shape;
  }
  // Adds frames that see the hand from different directions and bent by different amounts, and fits.
  void show(int looks) {
    for (int i = 0; i < looks; ++i) {
      const HandPose facing = test::facing_pose(*person_, 0.45, 0.15 + 0.1 * (i % 8));
      const HandPose truth = test::turned(facing, {0.4 * std::sin(i), 0.5 * std::cos(0.7 * i), 0}, facing[kPalm].t);
      const auto observation = test::observe_skin(persons_skin_, truth);
      const RefinedPose refined = model_->refinement.refine(*observation, truth, truth, 5);
      const auto change = fit_.add_frame(*observation, refined.pose, model_->refinement);
      if (change == PersonFit::Change::large)
        model_ = std::make_unique<HandModel>(params_, fit_.profile(), fit_.skin(), workers_, nullptr);
      if (change == PersonFit::Change::small)
        model_ =
            std::make_unique<HandModel>(params_, fit_.profile(), fit_.skin(), model_->initialiser, workers_, nullptr);
    }
  }
  double length_error(const HandProfile& hand) const {
    double sum = 0;
    for (int s = 1; s < kSegmentCount; ++s) sum += std::abs(hand.segments[s].length - person_->segments[s].length);
    return sum / (kSegmentCount - 1);
  }

  TrackerParams params_;
  Workers workers_{1};
  const std::shared_ptr<const HandProfile> mean_ = test::adult_hand();
  const std::shared_ptr<const HandProfile> person_ =
      std::make_shared<const HandProfile>(reshaped(*mean_, shape_of_the_person()));
  const Skin persons_skin_ = make_blended_skin(*person_, 0.004);
  std::unique_ptr<HandModel> model_ = std::make_unique<HandModel>(params_, mean_, workers_, nullptr);
  PersonFit fit_{params_.shape_fit, mean_, model_->skin, params_.skin_cell, workers_};
};

TEST_F(PersonFitTest, FindsThePersonsHand) {
  show(40);
  const HandProfile& fitted = *fit_.profile();
  EXPECT_LT(length_error(fitted), 0.3 * length_error(*mean_));
  EXPECT_NEAR(fitted.hand_length(), person_->hand_length(), 0.004);
  const int bone = segment_of(2, 1);
  EXPECT_NEAR(fitted.segments[bone].half_width[0], person_->segments[bone].half_width[0], 0.0005);
}

TEST_F(PersonFitTest, KnowsWhatItHasNotSeen) {
  const HandShape before = fit_.fit().deviation();
  for (int k = 0; k < kShapeCount; ++k) EXPECT_NEAR(before[k], shape_parameters()[k].deviation, 1e-9);
  show(10);
  const HandShape after = fit_.fit().deviation();
  EXPECT_LT(after[0], before[0]);
  for (int k = 0; k < kShapeCount; ++k) EXPECT_LE(after[k], before[k] + 1e-9) << shape_parameters()[k].name;
}

// Skins are built beside a live source; until the first is ready, frames change nothing, and none has to wait.
TEST_F(PersonFitTest, FitsBesideALiveSource) {
  Workers live(1);
  live.go_live();
  PersonFit fit(params_.shape_fit, mean_, model_->skin, params_.skin_cell, live);
  const HandPose truth = test::facing_pose(*person_, 0.45, 0.3);
  const auto observation = test::observe_skin(persons_skin_, truth);
  const RefinedPose refined = model_->refinement.refine(*observation, truth, truth, 5);
  EXPECT_EQ(fit.add_frame(*observation, refined.pose, model_->refinement), PersonFit::Change::none);

  auto change = PersonFit::Change::none;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (change == PersonFit::Change::none && std::chrono::steady_clock::now() < deadline) {
    change = fit.add_frame(*observation, refined.pose, model_->refinement);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(change, PersonFit::Change::small);
  EXPECT_NE(fit.skin(), model_->skin);
  EXPECT_EQ(fit.fit().frames(), 1);
}

}  // namespace
}  // namespace barehand
