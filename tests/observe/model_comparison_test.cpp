#include "observe/dense/model_comparison.h"

#include <algorithm>
#include <cmath>

#include "support/painted_hand.h"

namespace barehand {
namespace {

class CompareTest : public ::testing::Test {
 protected:
  ModelComparison compare_at(const HandObservation& observation, const HandPose& pose) {
    RenderedHand rendered;
    render_hand(skin_, pose, observation.frame->camera, grid_of(observation, params_.stride), rendered);
    projected_ = rendered.projected;
    ModelComparison out;
    compare(observation, skin_, pose, rendered, params_, out);
    return out;
  }
  HandPose shifted(const Eigen::Vector3d& by) const {
    HandPose pose = pose_;
    for (SE3& T : pose) T.t += by;
    return pose;
  }
  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  Skin skin_ = make_blended_skin(*profile_, 0.005);
  HandPose pose_ = test::facing_pose(*profile_, 0.45);
  std::shared_ptr<HandObservation> observation_ = test::observe_skin(skin_, pose_);
  ComparisonParams params_;
  std::array<int, kSegmentCount> projected_{};
};

TEST_F(CompareTest, ScoreIsZeroAtTheTruthAndGrowsWithDisplacement) {
  EXPECT_LT(compare_at(*observation_, pose_).score, 1e-5);
  const double near = compare_at(*observation_, shifted({0.002, 0, 0})).score;
  const double far = compare_at(*observation_, shifted({0.008, 0, 0})).score;
  EXPECT_GT(near, 1e-4);
  EXPECT_GT(far, 2 * near);
}

TEST_F(CompareTest, DepthShiftCostsItsLength) {
  EXPECT_NEAR(compare_at(*observation_, shifted({0, 0, 0.005})).score, 0.005, 0.001);
}

TEST_F(CompareTest, UnexplainedDataCosts) {
  // The tracker's fingers are curled while the visible ones are straight. The data of the straight ones must count.
  const ModelComparison curled = compare_at(*observation_, test::facing_pose(*profile_, 0.45, 1.3));
  int unexplained = 0;
  for (const Correspondence& c : curled.correspondences) unexplained += c.kind == Correspondence::Kind::unexplained;
  EXPECT_GT(unexplained, 50);
  EXPECT_GT(curled.score, 0.003);
}

TEST_F(CompareTest, MissingDepthIsNoEvidence) {
  for (std::size_t i = 0; i < observation_->label.size(); ++i) {
    observation_->label[i] = PixelLabel::unknown;
    observation_->depth[i] = 0;
  }
  const ModelComparison comparison = compare_at(*observation_, pose_);
  EXPECT_TRUE(comparison.correspondences.empty());
  EXPECT_EQ(comparison.score, params_.distance_cap);
}

// A hand before which nothing else was measured, and what contradicts a model that reaches too far.
class HoleTest : public CompareTest {
 protected:
  HoleTest() {
    for (std::size_t i = 0; i < observation_->label.size(); ++i)
      if (observation_->label[i] != PixelLabel::hand) forget(i);
  }
  void forget(std::size_t i) {
    observation_->label[i] = PixelLabel::unknown;
    observation_->depth[i] = 0;
  }
  // Finds the nearest hand pixels anew after some were forgotten.
  void find_hand() {
    Image<std::int32_t> hand(observation_->label.width(), observation_->label.height(), -1);
    for (std::size_t i = 0; i < hand.size(); ++i)
      if (observation_->label[i] == PixelLabel::hand) hand[i] = 1;
    observation_->nearest_hand = test::nearest_in(hand);
  }
  // Moves the hand 12 mm towards its fingertips, and returns the correspondences of skin that is in a hole.
  std::vector<Correspondence> in_holes(double by = 0.012) {
    std::vector<Correspondence> found;
    for (const Correspondence& c : compare_at(*observation_, shifted({0, -by, 0})).correspondences)
      if (c.kind == Correspondence::Kind::outside) found.push_back(c);
    return found;
  }
};

TEST_F(HoleTest, AFingerEndsWhereItsMeasuredPartDoes) {
  const std::vector<Correspondence> found = in_holes();
  EXPECT_GT(found.size(), 40u);
  for (const Correspondence& c : found) {
    EXPECT_GT(c.data.y(), c.model.y()) << "fingers point upwards, so they should move down";
    EXPECT_LE((c.data - c.model).head<2>().norm(), 0.0201f);
  }
  EXPECT_TRUE(in_holes(0).empty()) << "the true pose";
}

TEST_F(HoleTest, TheEvidenceHasItsWeight) {
  const float half = in_holes().front().weight;
  params_.missing_depth = 0.25;
  EXPECT_FLOAT_EQ(in_holes().front().weight, half / 2);
  params_.missing_depth = 0;
  EXPECT_TRUE(in_holes().empty());
}

TEST_F(HoleTest, AFingerThatIsMissingAsAWholeIsNotContradicted) {
  RenderedHand rendered;
  render_hand(skin_, pose_, observation_->frame->camera, grid_of(*observation_, 1), rendered);
  const auto of_middle = [&](std::int32_t vertex) {
    const int segment = skin_.vertices[vertex].a;
    return segment != kPalm && finger_of(segment) == 2;
  };
  for (std::size_t i = 0; i < rendered.vertex.size(); ++i)
    if (rendered.vertex[i] >= 0 && of_middle(rendered.vertex[i])) forget(i);
  find_hand();
  EXPECT_LT(in_holes(0).size(), 10u) << "at the knuckle alone";
}

TEST_F(HoleTest, TheShadowOfANearerObjectSaysNothing) {
  // An object surrounds the hand, with a hole of five pixels in between.
  const auto surround = [&](float z) {
    const int width = observation_->label.width(), height = observation_->label.height();
    Image<std::int32_t> object(width, height, -1);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        const std::int32_t hand = observation_->nearest_hand.at(u, v);
        if (std::max(std::abs(hand % width - u), std::abs(hand / width - v)) <= 5) continue;
        observation_->label.at(u, v) = PixelLabel::object;
        observation_->depth.at(u, v) = z;
        object.at(u, v) = 1;
      }
    observation_->nearest_object = test::nearest_in(object);
  };
  surround(0.35f);
  EXPECT_TRUE(in_holes(0.008).empty());
  surround(0.6f);
  EXPECT_GT(in_holes(0.008).size(), 20u) << "an object behind the hand casts no shadow on it";
}

TEST_F(CompareTest, AnObjectInFrontHidesWithoutContradicting) {
  for (int v = 0; v < 100; ++v)
    for (int u = 0; u < 320; ++u) {
      observation_->label.at(u, v) = PixelLabel::object;
      observation_->depth.at(u, v) = 0.3f;
    }
  const ModelComparison comparison = compare_at(*observation_, pose_);
  EXPECT_LT(comparison.score, 1e-5);
  const int tip = segment_of(2, 2);
  EXPECT_GT(projected_[tip], 0);
  EXPECT_EQ(comparison.visible[tip], 0);
}

TEST_F(CompareTest, AnObjectBehindContradicts) {
  for (int v = 0; v < 100; ++v)
    for (int u = 0; u < 320; ++u) {
      observation_->label.at(u, v) = PixelLabel::object;
      observation_->depth.at(u, v) = 0.6f;
    }
  EXPECT_GT(compare_at(*observation_, pose_).score, 0.002);
}

// An object to the right of column 200, in front of or behind the hand.
class HidingPlaceTest : public CompareTest {
 protected:
  ModelComparison compare_beside_object(float z) {
    constexpr int kEdge = 200;
    const int width = observation_->label.width(), height = observation_->label.height();
    observation_->nearest_object.reset(width, height, -1);

    // In each row, find the nearest object to the right.
    for (int v = 0; v < height; ++v)
      for (int u = width - 1, object = -1; u >= 0; --u) {
        const auto i = static_cast<std::int32_t>(observation_->label.index(u, v));
        if (u >= kEdge && observation_->label[i] != PixelLabel::hand) {
          observation_->label[i] = PixelLabel::object;
          observation_->depth[i] = z;
          object = i;
        }
        observation_->nearest_object[i] = object;
      }
    return compare_at(*observation_, shifted({0.02, 0, 0}));
  }
  int pulled_behind_object(const ModelComparison& comparison) const {
    const Intrinsics& camera = observation_->frame->camera;
    int count = 0;
    for (const Correspondence& c : comparison.correspondences) {
      const Eigen::Vector2d pixel = camera.project(c.data.cast<double>());
      const int u = static_cast<int>(std::lround(pixel.x())) - observation_->u0;
      const int v = static_cast<int>(std::lround(pixel.y())) - observation_->v0;
      count += c.kind == Correspondence::Kind::outside && c.data.z() == c.model.z() &&
               observation_->label.at(u, v) == PixelLabel::object;
    }
    return count;
  }
};

TEST_F(HidingPlaceTest, SkinOverBackgroundMayMoveBehindANearerObject) {
  EXPECT_GT(pulled_behind_object(compare_beside_object(0.3f)), 5);
}

TEST_F(HidingPlaceTest, NothingHidesBehindWhatIsFartherAway) {
  EXPECT_EQ(pulled_behind_object(compare_beside_object(0.6f)), 0);
}

// Skin slightly in front of data that is not hand is probably behind it in reality. The cost is the distance by which
// it is in front.
TEST_F(CompareTest, SkinThatStandsOutOfWhatIsSeenGoesBackIntoIt) {
  // The number of points that should move back if the data at the fingers has this label and is `by` [m] behind the
  // skin.
  const auto standing_out = [&](PixelLabel label, float by) {
    const auto other = std::make_shared<HandObservation>(*observation_);  // gets the label at the fingers
    for (int v = 0; v < 100; ++v)
      for (int u = 0; u < 320; ++u)
        if (other->label.at(u, v) != PixelLabel::background) other->label.at(u, v) = label;
    const float tolerance = label == PixelLabel::object ? static_cast<float>(params_.occlusion_tolerance) : 0.0f;
    ModelComparison comparison = compare_at(*other, shifted({0, 0, -by - tolerance}));
    std::erase_if(comparison.correspondences,
                  [](const Correspondence& c) { return c.kind != Correspondence::Kind::behind; });

    // They should move back along their line of sight by the distance `by`.
    for (const Correspondence& c : comparison.correspondences)
      EXPECT_LT((c.data.head<2>() / c.data.z() - c.model.head<2>() / c.model.z()).norm(), 1e-5);
    const auto is_back = [&](const Correspondence& c) { return std::abs(c.data.z() - c.model.z() - by) < 1e-3; };
    return std::ranges::count_if(comparison.correspondences, is_back);
  };

  // Only skin that is slightly in front should move back.
  for (const PixelLabel label : {PixelLabel::object, PixelLabel::background}) {
    EXPECT_GT(standing_out(label, 0.003f), 50);
    EXPECT_EQ(standing_out(label, 0.02f), 0) << "far out it goes aside";
    EXPECT_EQ(standing_out(label, -0.01f), 0) << "hidden";
  }
}

// A finger outside the outline of the hand needs only a small sideways motion to be hidden by the hand, at any depth.
TEST_F(CompareTest, SkinBesideTheHandMayHideBehindIt) {
  const auto aside = [&](double deeper) {
    int count = 0;
    for (const Correspondence& c : compare_at(*observation_, shifted({0.006, 0, deeper})).correspondences)
      count += c.kind == Correspondence::Kind::outside && c.data.z() == c.model.z();
    return count;
  };
  EXPECT_GT(aside(params_.self_occlusion + 0.01), 20);
  EXPECT_LT(aside(0), 3);
}

TEST_F(CompareTest, ForearmIsNotUnexplained) {
  // Hand-like data far behind the wrist, which is below it in the image.
  for (int v = 220; v < 240; ++v)
    for (int u = 140; u < 180; ++u) {
      observation_->label.at(u, v) = PixelLabel::hand;
      observation_->depth.at(u, v) = 0.45f;
    }
  EXPECT_LT(compare_at(*observation_, pose_).score, 1e-5);
}

}  // namespace
}  // namespace barehand
