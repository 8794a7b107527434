#include "stages/segment_tracker/segment_tracker.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/scene.h"

namespace barehand {
namespace {

constexpr int kTip = segment_of(1, 2);

SegmentTracker make_tracker(Workers& workers, const SegmentTrackerParams& params = {}) {
  return {params, std::make_shared<HandSurface>(make_cylinder_surface(capsule_profile(), 150)), workers};
}

/// A prediction with all segments at the upright capsule; the tests check kTip only.
HandPose prediction() {
  HandPose pose;
  pose.fill(upright_pose());
  return pose;
}

Proposals boxes(double translation, double rotation) {
  Vector6d half_width;
  half_width << Eigen::Vector3d::Constant(translation), Eigen::Vector3d::Constant(rotation);
  Proposals proposals;
  proposals.fill({{upright_pose(), half_width}});
  return proposals;
}

/// The upright capsule, whose left part up to column `covered_to` is behind an object 30 mm in front of it. Some pixels
/// of hand in the corner keep Eq. 1 defined if everything else is covered.
HandObservation covered_capsule(int covered_to) {
  const Intrinsics camera = small_camera();
  return make_observation(camera, [&](int u, int v) {
    if (u == 95 && v == 95) return ScenePixel{0.4f, PixelLabel::hand};
    return u < covered_to ? ScenePixel{0.37f, PixelLabel::object} : upright_capsule(camera, u, v);
  });
}

SegmentSamples sample(Workers& workers, const HandObservation& o, const SampleKey& key = {1, 0, 0, 1},
                      const SegmentTrackerParams& params = {}) {
  SegmentTracker tracker = make_tracker(workers, params);
  return tracker.sample(tracker.prepare(o, prediction()), boxes(0.008, 0.3), key);
}

double spread(const std::vector<double>& v) {
  return *std::max_element(v.begin(), v.end()) - *std::min_element(v.begin(), v.end());
}

TEST(SegmentTracker, TrueSampleBeatsDisplacedOnes) {
  Workers workers(1);
  SegmentTracker tracker = make_tracker(workers);
  const PreparedObservation prepared = tracker.prepare(covered_capsule(0), prediction());
  const double at_truth = tracker.compare(prepared, kTip, upright_pose()).mean();
  EXPECT_LT(at_truth, 0.0007);
  for (int axis = 0; axis < 3; ++axis)
    for (const double offset : {-0.006, -0.003, 0.003, 0.006}) {
      if (axis == 1 && offset > 0) continue;  // in the direction of the palm, the tip moves within its own outline
      SE3 T = upright_pose();
      T.t[axis] += offset;
      EXPECT_GT(tracker.compare(prepared, kTip, T).mean(), 1.5 * at_truth) << "axis " << axis << " by " << offset;
    }
}

TEST(SegmentTracker, LikelihoodFollowsEquationThree) {
  Workers workers(1);
  SegmentTracker tracker = make_tracker(workers);
  const PreparedObservation prepared = tracker.prepare(covered_capsule(48), prediction());
  const SegmentSamples samples = tracker.sample(prepared, boxes(0.002, 0.1), {1, 0, 2, 5});
  const double sigma_obs = 0.002;  // the geometric mean of 4 and 1 mm
  for (std::size_t i = 0; i < samples.poses[kTip].size(); ++i) {
    const double d = tracker.compare(prepared, kTip, samples.poses[kTip][i]).mean() / sigma_obs;
    EXPECT_NEAR(samples.log_likelihood[kTip][i], -samples.unoccluded[kTip] * d * d, 1e-9);
  }
  EXPECT_NEAR(samples.unoccluded[kTip], 0.5, 0.05);
}

TEST(SegmentTracker, MoreOcclusionMakesTheLikelihoodFlatter) {
  // Fig. 5: when the model moves along the viewing ray, the likelihood drops the less, the smaller alpha is.
  Workers workers(1);
  SegmentTracker tracker = make_tracker(workers);
  double last_drop = INFINITY;
  for (const int covered : {0, 42, 48, 54, 96}) {
    const PreparedObservation prepared = tracker.prepare(covered_capsule(covered), prediction());

    // One sample at the prediction, and one displaced in depth.
    Proposals proposals = boxes(0, 0);
    SE3 displaced = upright_pose();
    displaced.t.z() += 0.004;
    proposals[kTip].push_back({displaced, Vector6d::Zero()});

    const auto log_l = tracker.sample(prepared, proposals, {1, 0, 0, 1}).log_likelihood[kTip];
    const double drop = log_l[0] - log_l[1];
    EXPECT_LT(drop, last_drop) << "covered up to column " << covered;
    last_drop = drop;
  }
  EXPECT_EQ(last_drop, 0);
}

TEST(SegmentTracker, FullyHiddenSegmentIsFlat) {
  Workers workers(1);
  const SegmentSamples samples = sample(workers, covered_capsule(96));
  EXPECT_EQ(samples.unoccluded[kTip], 0);
  EXPECT_EQ(spread(samples.log_likelihood[kTip]), 0);
}

TEST(SegmentTracker, SamplesThatMoveIntoOcclusionAreNotPunished) {
  // The tip's end is in the upper half of the image. When it moves up by 5 mm, it leaves its own outline: either in
  // front of the background, or behind an object that covers everything above.
  const Intrinsics camera = small_camera();
  const auto tip_below = [&](PixelLabel above, float z) {
    return make_observation(camera, [&, above, z](int u, int v) {
      return v < 24 ? ScenePixel{z, above} : upright_capsule(camera, u, v);
    });
  };

  Workers workers(1);
  SegmentTracker tracker = make_tracker(workers);
  SE3 slid = upright_pose();
  slid.t.y() -= 0.005;
  const auto distance = [&](const HandObservation& o, const SE3& T) {
    return tracker.compare(tracker.prepare(o, prediction()), kTip, T).mean();
  };

  const HandObservation open = tip_below(PixelLabel::background, 1.0f), covered = tip_below(PixelLabel::object, 0.37f);
  EXPECT_NEAR(distance(covered, slid), distance(covered, upright_pose()), 0.0002);
  EXPECT_GT(distance(open, slid), distance(open, upright_pose()) + 0.0005);
}

TEST(SegmentTracker, SampleWithoutEvidenceGetsItsSiblingsMeanDistance) {
  Workers workers(1);
  SegmentTracker tracker = make_tracker(workers);
  const PreparedObservation prepared = tracker.prepare(covered_capsule(48), prediction());
  SE3 gone = upright_pose(), off = upright_pose();
  gone.t.x() -= 0.03;  // completely behind the object
  off.t.z() += 0.006;
  Proposals proposals = boxes(0, 0);
  proposals[kTip] = {{upright_pose(), Vector6d::Zero()}, {gone, Vector6d::Zero()}, {off, Vector6d::Zero()}};
  const auto log_l = tracker.sample(prepared, proposals, {1, 0, 0, 1}).log_likelihood[kTip];
  EXPECT_LT(log_l[1], log_l[0]);
  EXPECT_GT(log_l[1], log_l[2]);
}

TEST(SegmentTracker, CapBoundsAFarPixel) {
  Workers workers(1);
  SegmentTrackerParams uncapped;
  uncapped.pixel_distance_cap = 0;
  SE3 far = upright_pose();
  far.t.z() += 0.1;
  for (const auto& [params, expected] : {std::pair{SegmentTrackerParams{}, 0.008}, {uncapped, 0.1}}) {
    SegmentTracker tracker = make_tracker(workers, params);
    const HandObservation o = make_observation(small_camera(), [](int, int) {
      return ScenePixel{0.4f, PixelLabel::hand};
    });
    EXPECT_NEAR(tracker.compare(tracker.prepare(o, prediction()), kTip, far).mean(), expected, 0.008);
  }
}

TEST(SegmentTracker, MissingDepthLowersAlphaOnlyWhenItIsUnknown) {
  const Intrinsics camera = small_camera();
  const HandObservation o = make_observation(camera, [&](int u, int v) {
    return (u / 4 + v / 4) % 4 == 0 ? ScenePixel{0, PixelLabel::unknown} : upright_capsule(camera, u, v);
  });
  Workers workers(1);
  SegmentTrackerParams paper;
  paper.missing_depth = "background";
  SegmentTracker ours = make_tracker(workers), papers = make_tracker(workers, paper);
  const PreparedObservation a = ours.prepare(o, prediction()), b = papers.prepare(o, prediction());
  EXPECT_NEAR(a.unoccluded[kTip], 0.75, 0.08);
  EXPECT_NEAR(b.unoccluded[kTip], 1, 0.01);
  EXPECT_LT(ours.compare(a, kTip, upright_pose()).mean(), 0.8 * papers.compare(b, kTip, upright_pose()).mean());
}

TEST(SegmentTracker, PalmIsFlatWhereItIsNotObserved) {
  Workers workers(1);
  SegmentTrackerParams params;
  EXPECT_GT(spread(sample(workers, covered_capsule(0), {}, params).log_likelihood[kPalm]), 0);
  params.observe_palm = false;
  const SegmentSamples samples = sample(workers, covered_capsule(0), {}, params);
  EXPECT_EQ(samples.log_likelihood[kPalm], std::vector<double>(samples.poses[kPalm].size(), 0.0));
}

TEST(SegmentTracker, ResultDoesNotDependOnTheNumberOfWorkers) {
  Workers one(1), four(4);
  const SegmentSamples a = sample(one, covered_capsule(48)), b = sample(four, covered_capsule(48));
  EXPECT_EQ(a.log_likelihood, b.log_likelihood);
  EXPECT_EQ(a.unoccluded, b.unoccluded);
  for (int s = 0; s < kSegmentCount; ++s)
    for (std::size_t i = 0; i < a.poses[s].size(); ++i) {
      EXPECT_EQ(a.poses[s][i].t, b.poses[s][i].t);
      EXPECT_EQ(a.poses[s][i].R, b.poses[s][i].R);
    }
}

TEST(SegmentTracker, EqualKeysReproduceAndLevelsDiffer) {
  Workers workers(1);
  const HandObservation o = covered_capsule(0);
  EXPECT_EQ(sample(workers, o, {1, 5, 0, 3}).log_likelihood, sample(workers, o, {1, 5, 0, 3}).log_likelihood);
  EXPECT_NE(sample(workers, o, {1, 5, 0, 3}).poses[kTip][9].t, sample(workers, o, {1, 5, 1, 3}).poses[kTip][9].t);
}

}  // namespace
}  // namespace barehand
