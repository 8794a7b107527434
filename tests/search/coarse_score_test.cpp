#include "stages/search/coarse_score.h"

#include <gtest/gtest.h>

#include <numbers>

#include "stages/prediction/motion_prediction.h"
#include "stages/search/start_templates.h"
#include "support/point_world.h"

namespace barehand {
namespace {

class CoarseScore : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(profile_);
    skin_ = make_coarse_skin(*profile_, make_cylinder_surface(*profile_, 600), 0.005);
    truth_ = forward_kinematics(*profile_, {palm_orientation(0.1, 0.1, 0.3), {0.02, 0.06, 0.4}}, {});
    observation_ = test::PointWorld(*profile_, test::PointWorld::Arm::none).observe(truth_);
    grid_ = make_score_grid(*observation_, 0.005);
    params_.no_forearm = 0;  // no penalty, since the rendered hand has no arm
  }
  double score(const HandPose& pose) const { return CoarseScorer(grid_, skin_, params_)(pose); }
  HandPose shifted(const Eigen::Vector3d& t) const { return moved({Eigen::Matrix3d::Identity(), t}, truth_); }

  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  CoarseSkin skin_;
  HandPose truth_;
  std::shared_ptr<HandObservation> observation_;
  ScoreGrid grid_;
  CoarseScoreParams params_;
};

TEST_F(CoarseScore, TheTruthIsNearlyFree) { EXPECT_LT(score(truth_), 0.2); }

TEST_F(CoarseScore, GrowsWithEveryShift) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      double last = score(truth_);
      for (const double shift : {0.01, 0.02, 0.03}) {
        const double now = score(shifted(sign * shift * Eigen::Vector3d::Unit(axis)));
        EXPECT_GT(now, last + 0.02) << "axis " << axis << ", shift " << sign * shift;
        last = now;
      }
    }
  }
}

TEST_F(CoarseScore, ABackIsNotAPalm) {
  const Eigen::Vector3d centre = truth_[kPalm] * Eigen::Vector3d(0, 0, -0.08);
  const Eigen::Vector3d along = truth_[kPalm].R.col(2);
  const Eigen::Matrix3d R = exp_so3(std::numbers::pi * along);
  EXPECT_GT(score(moved({R, centre - R * centre}, truth_)), score(truth_) + 0.15);
}

TEST_F(CoarseScore, HiddenByAnObjectIsCheaperThanBeforeTheBackground) {
  const HandPose away = shifted({0.1, 0, 0});
  const double on_background = score(away);
  test::PointWorld::occlude(*observation_, 190, 0.3f);
  grid_ = make_score_grid(*observation_, 0.005);
  EXPECT_LT(score(away), 0.8 * on_background);
}

TEST_F(CoarseScore, AForearmInTheAirCostsAndASleeveDoesNot) {
  const double without = score(truth_);
  params_.no_forearm = 1;
  EXPECT_GT(score(truth_), without + 0.1);
  observation_ = test::PointWorld(*profile_).observe(truth_);
  grid_ = make_score_grid(*observation_, 0.005);
  EXPECT_LT(score(truth_), without + 0.05);
}

TEST_F(CoarseScore, LeavingTheRegionCosts) { EXPECT_GT(score(shifted({0.4, 0, 0})), score(shifted({0.05, 0, 0}))); }

TEST_F(CoarseScore, NothingSeenOrNotFiniteIsInfinite) {
  HandPose broken = truth_;
  broken[3].t.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isinf(score(broken)));
  EXPECT_TRUE(std::isinf(CoarseScorer(ScoreGrid{}, skin_, params_)(truth_)));
}

TEST_F(CoarseScore, GridFindsTheHand) {
  EXPECT_NEAR(grid_.cell, 0.005, 0.0012);
  EXPECT_NEAR(grid_.hand_cells * grid_.cell * grid_.cell, observation_->hand_pixels.size() * std::pow(0.4 / 240, 2),
              0.003);
  const Eigen::Vector3d palm = truth_[kPalm] * Eigen::Vector3d(0, 0, -0.06);
  EXPECT_LT((grid_.palm_centre - palm).norm(), 0.03);
}

TEST_F(CoarseScore, CellsProjectLikePixels) {
  // A point at pixel (100, 80) lies in the cell that contains that pixel.
  const Eigen::Vector3d p = observation_->frame->camera.unproject(100, 80, 0.4);
  const Eigen::Vector2d cell = grid_.camera.project(p);
  const double size = grid_.cell * 240 / 0.4;
  EXPECT_NEAR(std::lround(cell.x()), std::floor(100 / std::round(size)), 0.1);
  EXPECT_NEAR(std::lround(cell.y()), std::floor(80 / std::round(size)), 0.1);
}

}  // namespace
}  // namespace barehand
