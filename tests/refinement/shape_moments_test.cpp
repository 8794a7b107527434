#include "stages/refinement/shape_moments.h"

#include <Eigen/Dense>

#include "math/random.h"
#include "stages/refinement/hand_energy.h"
#include "support/painted_hand.h"

namespace barehand {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3f;
using Eigen::VectorXd;

/// Random evidence on a bent hand, weighted as plain least squares so that all derivatives are exact.
class ShapeMomentsTest : public ::testing::Test {
 protected:
  ShapeMomentsTest() {
    params_.robust_scale = params_.silhouette_scale = 100;
    params_.gate = params_.silhouette_gate = 10;
    std::vector<Vector3f> posed;
    pose_skin(skin_, pose_, posed);
    KeyedRandom random(3, 1);
    for (int i = 0; i < 400; ++i) {
      Correspondence c;
      c.kind = static_cast<Correspondence::Kind>(i % 3);
      c.vertex = static_cast<int>(random.bits() % posed.size());
      const SkinVertex& v = skin_.vertices[c.vertex];
      c.model = posed[c.vertex];
      c.normal = pose_[v.a].R.cast<float>() * v.normal_in_a;
      c.data = c.model + 0.003f * Vector3f(random.normal(), random.normal(), random.normal());
      c.weight = 1;
      evidence_.correspondences.push_back(c);
    }
  }

  // The evidence after a change of the shape, which moves the skin but not the data.
  ModelComparison reshaped_evidence(const HandShape& change) const {
    ModelComparison moved;
    moved.correspondences = evidence_.correspondences;
    for (Correspondence& c : moved.correspondences) {
      const float outward = static_cast<float>(basis_.outward.row(c.vertex).cast<double>().dot(change));
      c.model += outward * c.normal;
    }
    return moved;
  }
  HandProfile profile_after(const HandShape& change) const { return reshaped(*mean_, change); }

  double energy(const HandShape& change) const {
    GaussianTree unused;
    unused.set_zero();
    double total = add_data_terms(skin_, pose_, reshaped_evidence(change), params_, {.tangential = 0.5}, unused);
    return total + add_joint_terms(profile_after(change), limits_, pose_, params_, unused);
  }

  ShapeEquations equations() const {
    ShapeEquations out;
    out.set_zero();
    ShapeMoments moments;
    moments.reset(pose_, skin_.vertices.size());
    add_data_terms(skin_, pose_, evidence_, params_, {.tangential = 0.5}, out.tree, &moments);
    add_joint_terms(*mean_, limits_, pose_, params_, out.tree);
    moments.add_to(skin_, basis_, out);
    add_joint_shape(*mean_, pose_, basis_, params_.sigma_gap, out);
    return out;
  }

  static HandPose bent(const HandProfile& profile) {
    HandPose pose = test::facing_pose(profile, 0.45, 0.5);
    KeyedRandom random(3, 2);
    for (SE3& T : pose) {
      Vector6d twist;
      for (int i = 0; i < 6; ++i) twist[i] = random.uniform(-1, 1) * (i < 3 ? 0.001 : 0.1);
      T = boxplus(T, twist);
    }
    return pose;
  }

  std::shared_ptr<const HandProfile> mean_ = test::adult_hand();
  Skin skin_ = make_blended_skin(*mean_, 0.008);
  ShapeBasis basis_ = shape_basis(*mean_, HandShape::Zero(), skin_);
  HandPose pose_ = bent(*mean_);
  std::array<JointLimits, kSegmentCount> limits_ = widened_limits(*mean_, 0.2);
  EnergyParams params_;
  ModelComparison evidence_;
};

TEST_F(ShapeMomentsTest, GradientMatchesCentralDifferences) {
  const ShapeEquations at = equations();
  const double scale = at.g_shape.cwiseAbs().maxCoeff();
  for (int k = 0; k < kShapeCount; ++k) {
    const double step = 0.02 * shape_parameters()[k].deviation;
    const double numeric = 0.5 * (energy(step * HandShape::Unit(k)) - energy(-step * HandShape::Unit(k))) / (2 * step);
    EXPECT_NEAR(at.g_shape[k], -numeric, 0.01 * std::abs(numeric) + 1e-4 * scale) << shape_parameters()[k].name;
  }
}

TEST_F(ShapeMomentsTest, MixedBlocksAreHowTheShapeChangesThePosesGradient) {
  // The gradient of the pose as a function of the shape.
  const ShapeEquations at = equations();
  const auto pose_gradient = [&](const HandShape& change) {
    GaussianTree tree;
    tree.set_zero();
    add_data_terms(skin_, pose_, reshaped_evidence(change), params_, {.tangential = 0.5}, tree);
    add_joint_terms(profile_after(change), limits_, pose_, params_, tree);
    return tree.g;
  };

  // Its numeric derivative equals the mixed blocks.
  double worst = 0, scale = 0;
  for (int k = 0; k < kShapeCount; ++k) {
    const double step = 0.02 * shape_parameters()[k].deviation;
    const auto more = pose_gradient(step * HandShape::Unit(k)), less = pose_gradient(-step * HandShape::Unit(k));
    for (int s = 0; s < kSegmentCount; ++s) {
      const Vector6d numeric = -(more[s] - less[s]) / (2 * step);
      worst = std::max(worst, (at.H_pose_shape[s].col(k) - numeric).cwiseAbs().maxCoeff());
      scale = std::max(scale, numeric.cwiseAbs().maxCoeff());
    }
  }
  EXPECT_LT(worst, 0.02 * scale);
}

TEST_F(ShapeMomentsTest, SchurComplementEqualsTheDenseOne) {
  // The whole system as dense matrices.
  const ShapeEquations at = equations();
  constexpr int n = 6 * kSegmentCount;
  MatrixXd H = MatrixXd::Zero(n, n), cross(n, kShapeCount);
  VectorXd g(n);
  for (int s = 0; s < kSegmentCount; ++s) {
    H.block<6, 6>(6 * s, 6 * s) = at.tree.H_self[s];
    cross.middleRows<6>(6 * s) = at.H_pose_shape[s];
    g.segment<6>(6 * s) = at.tree.g[s];
    if (s == kPalm) continue;
    H.block<6, 6>(6 * s, 6 * parent_of(s)) = at.tree.H_parent[s];
    H.block<6, 6>(6 * parent_of(s), 6 * s) = at.tree.H_parent[s].transpose();
  }

  // The Schur complement, computed densely and by the tree.
  const MatrixXd information = at.H_shape - cross.transpose() * H.llt().solve(cross);
  const VectorXd gradient = at.g_shape - cross.transpose() * H.llt().solve(g);
  Eigen::Matrix<double, kShapeCount, kShapeCount> S;
  HandShape reduced;
  ASSERT_TRUE(at.without_pose(S, reduced));
  EXPECT_LT((S - information).norm(), 1e-6 * information.norm());
  EXPECT_LT((reduced - gradient).norm(), 1e-6 * gradient.norm());
}

}  // namespace
}  // namespace barehand
