#include "stages/refinement/hand_energy.h"

#include "gradient_error.h"
#include "math/angles.h"
#include "math/random.h"
#include "support/painted_hand.h"

namespace barehand {
namespace {

using Kind = Correspondence::Kind;

class EnergyTest : public ::testing::Test {
 protected:
  EnergyTest() {
    pose_ = test::facing_pose(*profile_, 0.45, 0.5);
    KeyedRandom random(1, 1);
    for (SE3& T : pose_) {
      Vector6d twist;
      for (int i = 0; i < 6; ++i) twist[i] = random.uniform(-1, 1) * (i < 3 ? 0.002 : 0.25);
      T = boxplus(T, twist);
    }
  }

  // Random evidence of every kind, attached to skin vertices.
  ModelComparison evidence() const {
    ModelComparison comparison;
    KeyedRandom random(1, 2);
    std::vector<Eigen::Vector3f> posed;
    pose_skin(skin_, pose_, posed);
    for (int i = 0; i < 300; ++i) {
      Correspondence c;
      c.kind = static_cast<Kind>(i % 4);
      c.vertex = static_cast<int>(random.bits() % posed.size());

      c.model = posed[c.vertex];
      c.normal = Eigen::Vector3f(random.normal(), random.normal(), random.normal()).normalized();
      c.data = c.model + 0.003f * Eigen::Vector3f(random.normal(), random.normal(), random.normal());
      c.weight = 1;
      comparison.correspondences.push_back(c);
    }
    return comparison;
  }

  GaussianTree data_terms(const ModelComparison& comparison, const DataWeighting& weighting) const {
    GaussianTree tree;
    tree.set_zero();
    add_data_terms(skin_, pose_, comparison, params_, weighting, tree);
    return tree;
  }

  // Energy of the evidence when its model points move with the skin.
  double data_energy(ModelComparison comparison, const HandPose& pose, const DataWeighting& weighting) const {
    for (Correspondence& c : comparison.correspondences) {
      const SkinVertex& v = skin_.vertices[c.vertex];
      const auto carried = [&](int s) { return pose[s] * (pose_[s].inverse() * c.model.cast<double>()); };
      c.model = ((1 - v.weight_b) * carried(v.a) + v.weight_b * carried(v.b)).cast<float>();
    }
    GaussianTree unused;
    unused.set_zero();
    return add_data_terms(skin_, pose, comparison, params_, weighting, unused);
  }

  template <class Energy>
  double gradient_error(const Energy& energy, const GaussianTree& tree, double step) const {
    return test::gradient_error(energy, pose_, tree, step);
  }

  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  Skin skin_ = make_blended_skin(*profile_, 0.006);
  EnergyParams params_;
  HandPose pose_;
};

TEST_F(EnergyTest, DataGradientMatchesCentralDifferences) {
  const ModelComparison comparison = evidence();
  for (const DataWeighting& weighting : {DataWeighting{}, {.tangential = 0.4}, {.tangential = 1, .folds = 4}}) {
    GaussianTree tree = data_terms(comparison, weighting);
    const auto energy = [&](const HandPose& pose) { return data_energy(comparison, pose, weighting); };
    // Points in single precision limit the accuracy.
    EXPECT_LT(gradient_error(energy, tree, 2e-4), 0.02) << weighting.tangential;
    tree.g[segment_of(1, 1)] *= 0.5;
    EXPECT_GT(gradient_error(energy, tree, 2e-4), 0.05) << "the check must notice a wrong gradient";
  }
}

// Displacements of unexplained data along the surface have the weight `tangential`; those along the normal count fully.
TEST_F(EnergyTest, UnexplainedDataPullsAlongTheSurfaceOnlyAsFarAsItShall) {
  ModelComparison comparison = evidence();
  std::erase_if(comparison.correspondences, [](const Correspondence& c) { return c.kind != Kind::unexplained; });
  for (Correspondence& c : comparison.correspondences) c.data = c.model + 0.004f * c.normal.unitOrthogonal();
  const auto pull = [&](double tangential) {
    const GaussianTree tree = data_terms(comparison, {.tangential = tangential});
    double sum = 0;
    for (const Vector6d& g : tree.g) sum += g.norm();
    return sum;
  };
  EXPECT_LT(pull(0), 1e-3 * pull(1));
  for (Correspondence& c : comparison.correspondences) c.data = c.model + 0.004f * c.normal;
  EXPECT_NEAR(pull(0), pull(1), 1e-3 * pull(1));
}

TEST_F(EnergyTest, PalmSkinCountsLessThanPhalanges) {
  const auto information = [&](double palm_trust) {
    params_.palm_trust = palm_trust;
    return data_terms(evidence(), {.tangential = 1});
  };
  const GaussianTree equal = information(1), trusted_less = information(0.1);
  const int tip = segment_of(2, 2), thumb_root = segment_of(0, 0);
  EXPECT_TRUE(trusted_less.H_self[tip].isApprox(equal.H_self[tip]));
  EXPECT_LT(trusted_less.H_self[kPalm](0, 0), 0.3 * equal.H_self[kPalm](0, 0));
  EXPECT_LT(trusted_less.H_self[thumb_root](0, 0), 0.5 * equal.H_self[thumb_root](0, 0));
}

TEST_F(EnergyTest, FoldsCountLessTheMoreEvenlyTwoSegmentsShareThem) {
  // A vertex that follows two segments.
  ModelComparison comparison = evidence();
  comparison.correspondences.resize(1);
  SkinVertex& v = skin_.vertices[comparison.correspondences[0].vertex];
  v.a = segment_of(2, 1);
  v.b = segment_of(2, 2);

  // The ratio of the information to that without the penalty.
  const auto fraction = [&](float share) {
    v.weight_b = share;
    return data_terms(comparison, {.folds = 4}).H_self[v.a].trace() / data_terms(comparison, {}).H_self[v.a].trace();
  };
  EXPECT_NEAR(fraction(0), 1, 1e-6);
  EXPECT_NEAR(fraction(0.25f), 0.5, 1e-6);
  EXPECT_NEAR(fraction(0.75f), 0.5, 1e-6);
  EXPECT_NEAR(fraction(0.5f), 0.2, 1e-6);
}

TEST_F(EnergyTest, PullAtTheJointsOfAHiddenSegmentMovesItsNeighbours) {
  // The normal equations with a hidden segment.
  const int root = segment_of(1, 0);
  params_.palm_trust = 1;
  DataWeighting weighting;
  weighting.hidden[root] = 1;
  const GaussianTree hidden = data_terms(evidence(), weighting);

  // They equal those of a skin whose shared vertices follow the other segment alone.
  const ModelComparison comparison = evidence();
  for (SkinVertex& v : skin_.vertices)
    if (v.weight_b > 0 && (v.a == root || v.b == root)) v.weight_b = v.a == root ? 1 : 0;
  const GaussianTree bound_to_others = data_terms(comparison, {});
  for (int s = 0; s < kSegmentCount; ++s) {
    EXPECT_TRUE(hidden.H_self[s].isApprox(bound_to_others.H_self[s])) << s;
    EXPECT_TRUE(hidden.g[s].isApprox(bound_to_others.g[s])) << s;
  }
  EXPECT_GT(hidden.H_self[root].trace(), 0) << "its own skin still pulls";
}

TEST_F(EnergyTest, JointGradientMatchesCentralDifferences) {
  const auto limits = widened_limits(*profile_, 0);
  GaussianTree tree;
  tree.set_zero();
  add_joint_terms(*profile_, limits, pose_, params_, tree);
  const auto energy = [&](const HandPose& pose) {
    GaussianTree unused;
    unused.set_zero();
    return add_joint_terms(*profile_, limits, pose, params_, unused);
  };
  EXPECT_LT(gradient_error(energy, tree, 1e-6), 1e-5);
}

TEST_F(EnergyTest, PriorGradientIsExactForSmallTurns) {
  // The normal equations of the prior.
  HandPose predicted = pose_;
  for (int s = 0; s < kSegmentCount; ++s)
    predicted[s] = boxplus(predicted[s], Vector6d::Constant(0.3 * kDegree * (s % 3)));
  std::array<double, kSegmentCount> seen;
  seen.fill(0.3);
  GaussianTree tree;
  tree.set_zero();
  add_prior_terms(*profile_, predicted, seen, pose_, params_, tree);

  // They agree with the numeric gradient.
  const auto energy = [&](const HandPose& pose) {
    GaussianTree unused;
    unused.set_zero();
    return add_prior_terms(*profile_, predicted, seen, pose, params_, unused);
  };
  EXPECT_LT(gradient_error(energy, tree, 1e-5), 0.01);
}

TEST_F(EnergyTest, JointsWithinTheirLimitsCostNothing) {
  GaussianTree tree;
  tree.set_zero();
  const HandPose closed = test::facing_pose(*profile_, 0.45, 0.5);
  EXPECT_LT(add_joint_terms(*profile_, widened_limits(*profile_, 0.2), closed, params_, tree), 1e-9);
}

}  // namespace
}  // namespace barehand
