#include "stages/contact/object_model.h"

#include <gtest/gtest.h>

#include <memory>

namespace barehand {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

/// A model of a corner of a box, three squares of 60 mm, that was fused from several frames at one pose.
class Model : public testing::Test {
 protected:
  Model() {
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 20; ++j)
        for (int axis = 0; axis < 3; ++axis) {
          Vector3f p = Vector3f::Zero(), n = Vector3f::Zero();
          p[(axis + 1) % 3] = 0.003f * static_cast<float>(i), p[(axis + 2) % 3] = 0.003f * static_cast<float>(j);
          n[axis] = -1;
          corner_.push_back({p, n});
        }
    for (int k = 0; k < 4; ++k) fuse(corner_, {});
  }
  static SE3 placed() { return {Eigen::Matrix3d::Identity(), Vector3d(0, 0, 0.5)}; }
  static std::vector<const SurfacePoint*> pointers(const std::vector<SurfacePoint>& points) {
    std::vector<const SurfacePoint*> all;
    for (const SurfacePoint& point : points) all.push_back(&point);
    return all;
  }
  static std::vector<SurfacePoint> moved(std::vector<SurfacePoint> points, const SE3& T) {
    for (SurfacePoint& point : points) {
      point.p = (T * point.p.cast<double>()).cast<float>();
      point.n = T.R.cast<float>() * point.n;
    }
    return points;
  }
  void fuse(const std::vector<SurfacePoint>& points, const ObservedSpace& space) {
    const auto there = moved(points, placed());
    model_.fuse(placed(), pointers(there), space);
  }
  /// Space in front of a wall that fills the view.
  static ObservedSpace before_wall(double z) {
    auto frame = std::make_shared<RgbdFrame>();
    frame->camera = {100, 100, 100, 100, 50, 50};
    auto observation = std::make_shared<HandObservation>();
    observation->frame = frame;
    observation->hand_present = true;
    observation->depth.reset(100, 100, static_cast<float>(z));
    kept().push_back(observation);
    ObservedSpace space;
    space.observe({observation});
    return space;
  }
  static std::vector<HandObservationPtr>& kept() {
    static std::vector<HandObservationPtr> observations;
    return observations;
  }

  std::vector<SurfacePoint> corner_;  // in its own frame
  ObjectModel model_;
};

TEST_F(Model, FindsThePoseOfACorner) {
  Vector6d twist;
  twist << 0.003, -0.002, 0.003, 0.02, -0.03, 0.02;
  const SE3 truth = boxplus(placed(), twist);
  const auto points = moved(corner_, truth);
  Matrix6d covariance;
  const SE3 found = model_.align(placed(), pointers(points), covariance);
  const Vector6d error = boxminus(found, truth);
  EXPECT_LT(error.head<3>().norm(), 0.0015) << "it was 4.7 mm";
  EXPECT_LT(error.tail<3>().norm(), 0.015) << "it was 0.04";
  EXPECT_LT(model_.misfit(found, pointers(points), {}), model_.misfit(placed(), pointers(points), {}));
  EXPECT_LT(covariance.diagonal().head<3>().maxCoeff(), 2e-6);
}

TEST_F(Model, APlaneThatSlidesOverItselfStaysAsPredicted) {
  std::vector<SurfacePoint> side;
  for (const SurfacePoint& point : corner_)
    if (point.n.z() < 0) side.push_back(point);
  const auto points = moved(side, {Eigen::Matrix3d::Identity(), Vector3d(0.005, 0, 0.502)});
  Matrix6d covariance;
  const SE3 found = model_.align(placed(), pointers(points), covariance);
  EXPECT_NEAR(found.t.z(), 0.502, 0.0006);
  EXPECT_NEAR(found.t.x(), 0, 0.0006);
  EXPECT_GT(covariance(0, 0), 10 * covariance(2, 2)) << "which the covariance says";
}

TEST_F(Model, GivesWhatIsHiddenAndNotWhatIsSeenToBeElsewhere) {
  std::vector<SurfacePoint> hidden;
  model_.append_hidden(placed(), before_wall(0.4), 5, hidden);  // the wall covers all of it
  EXPECT_GT(hidden.size(), 300u);
  EXPECT_EQ(hidden[0].object, 5);
  hidden.clear();
  model_.append_hidden(placed(), before_wall(1), 5, hidden);
  EXPECT_TRUE(hidden.empty());
}

TEST_F(Model, ForgetsWhatIsSeenToBeElsewhere) {
  const std::vector<SurfacePoint> nothing;
  for (int k = 0; k < 12; ++k) fuse(nothing, before_wall(1));
  EXPECT_FALSE(model_.has_surface());
}

TEST_F(Model, ForgetsWhatFacesTheCameraAndIsNotMeasured) {
  const std::size_t all = model_.surface().size();
  const std::vector<SurfacePoint> nothing;
  for (int k = 0; k < 25; ++k) fuse(nothing, before_wall(0));
  EXPECT_LT(model_.surface().size(), 0.75 * all) << "the side that faces the camera is gone";
  EXPECT_GT(model_.surface().size(), 0.5 * all) << "the sides along the line of sight stay";
}

TEST_F(Model, AMotionThatIsTooFastForItsPredictionIsFoundByTheMiddleOfWhatIsSeen) {
  const SE3 truth{Eigen::Matrix3d::Identity(), placed().t + Vector3d(0.03, 0.02, 0.04)};
  std::vector<SurfacePoint> front;
  for (const SurfacePoint& point : corner_)
    if (point.n.z() < 0) front.push_back(point);
  const auto points = moved(front, truth);
  const SE3 found = model_.centred(placed(), pointers(points), {});
  EXPECT_LT((found.t - truth.t).norm(), 0.004) << "it was 54 mm";
}

TEST_F(Model, APoseThatIsSeenToBeWrongIsNotCredible) {
  for (int k = 0; k < 5; ++k) fuse(corner_, before_wall(0.503));  // the space before it is empty
  const auto there = moved(corner_, placed());
  EXPECT_LT(model_.contradiction(placed(), pointers(there), {}), 0.05);
  const SE3 behind{Eigen::Matrix3d::Identity(), placed().t + Vector3d(0, 0, 0.012)};
  EXPECT_GT(model_.contradiction(behind, pointers(there), {}), 0.25) << "points lie where nothing was";
  EXPECT_GT(model_.contradiction(placed(), {}, before_wall(1)), 0.9) << "one looks through it";
}

TEST_F(Model, RemembersEmptySpaceAroundIt) {
  const Vector3f before(0.03f, 0.03f, -0.012f), behind(0.03f, 0.03f, 0.04f);
  EXPECT_FALSE(model_.seen_empty(before));
  for (int k = 0; k < 5; ++k) fuse(corner_, before_wall(0.503));
  EXPECT_TRUE(model_.seen_empty(before));
  EXPECT_FALSE(model_.seen_empty(behind));
}

}  // namespace
}  // namespace barehand
