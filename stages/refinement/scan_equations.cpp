#include "stages/refinement/scan_equations.h"

#include <algorithm>

#include "hand/joint_linearisation.h"
#include "math/angles.h"
#include "stages/refinement/residual_moments.h"

namespace barehand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

// Deviations of single residuals. A frame has thousands of them, which err alike.
constexpr double kSigmaDepth = 0.00045;        // m, of a surface distance
constexpr double kSigmaGap = 0.00011;          // m, of a joint (Eq. 5)
constexpr double kSigmaAngle = 1.8 * kDegree;  // beyond the limits, and twist (Eq. 6)
constexpr double kSigmaTurn = 4.5 * kDegree;   // of one step of a joint, so that a hidden one stays
constexpr float kRobustScale = 0.004f;         // m, Geman-McClure
constexpr float kGate = 0.012f;                // m, larger distances are something else
constexpr float kFacing = 0.3f;                // cosine: skin that turns away is not measured well
constexpr double kDamping = 1e-3;              // relative, Levenberg
constexpr double kLongestStep = 0.010;         // m
constexpr double kLargestTurn = 17 * kDegree;

double sq(double x) { return x * x; }

Eigen::MatrixXd dense(const GaussianTree& tree) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * kSegmentCount, 6 * kSegmentCount);
  for (int s = 0; s < kSegmentCount; ++s) {
    H.block<6, 6>(6 * s, 6 * s) = tree.H_self[s];
    if (s == kPalm) continue;
    const int parent = parent_of(s);
    H.block<6, 6>(6 * s, 6 * parent) = tree.H_parent[s];
    H.block<6, 6>(6 * parent, 6 * s) = tree.H_parent[s].transpose();
  }
  return H;
}

}  // namespace

void ScanEquations::set_zero(int count) {
  H.setZero(count, count);
  g.setZero(count);
}

bool ScanFrameEquations::linearise(const ScanFrame& frame, const ScanModel& model, const ScanVariables& variables,
                                   const std::array<JointLimits, kSegmentCount>& limits, bool hold_pose) {
  GaussianTree tree;
  tree.set_zero();
  add_skin(frame, model, variables, tree);
  add_joints(frame.pose, model, limits, tree);
  couple(model, variables);
  return eliminate_pose(tree, hold_pose);
}

void ScanFrameEquations::add_skin(const ScanFrame& frame, const ScanModel& model, const ScanVariables& variables,
                                  GaussianTree& tree) {
  const ComparisonParams params;
  const HandObservation& observation = *frame.observation;
  RenderedHand rendered;
  ModelComparison comparison;
  render_hand(model.skin, frame.pose, observation.frame->camera, grid_of(observation, params.stride), rendered);
  compare(observation, model.skin, frame.pose, rendered, params, comparison);
  std::vector<int> slot(model.skin.vertices.size(), -1);  // of every vertex in sums_
  sums_.clear();
  squares_ = 0;
  residuals_ = 0;
  ResidualMoments poses(frame.pose);
  for (const Correspondence& c : comparison.correspondences) {
    const float r = c.normal.dot(c.model - c.data);
    if (c.kind != Correspondence::Kind::surface || std::abs(r) > kGate) continue;
    if (-c.model.normalized().dot(c.normal) < kFacing) continue;
    const SkinVertex& v = model.skin.vertices[c.vertex];
    const double robust = sq(kRobustScale) / (sq(kRobustScale) + sq(r));
    const double w = c.weight / sq(kSigmaDepth) * sq(robust);
    poses.add(v, c.model, c.normal, r, static_cast<float>(w));
    squares_ += sq(r);
    ++residuals_;

    if (slot[c.vertex] < 0) {
      slot[c.vertex] = static_cast<int>(sums_.size());
      sums_.push_back({c.vertex, variables.offset(c.vertex), variables.share(c.vertex)});
    }
    VertexSums& sums = sums_[slot[c.vertex]];
    const auto posed = [&](int s, const Vector3f& p) -> Vector3d { return frame.pose[s] * p.cast<double>(); };
    const Vector3d normal = c.normal.cast<double>(), model_point = c.model.cast<double>();
    const double by_share = normal.dot(posed(v.b, v.in_b) - posed(v.a, v.in_a));
    const auto twist = [&](int s, double share) {
      return (PoseColumn() << share * normal, share * (model_point - frame.pose[s].t).cross(normal)).finished();
    };
    const PoseColumn a = twist(v.a, 1 - v.weight_b), b = twist(v.b, v.weight_b);
    sums.oo += w;
    sums.os += w * by_share;
    sums.ss += w * sq(by_share);
    sums.g_o -= w * r;
    sums.g_s -= w * by_share * r;
    sums.ao += w * a;
    sums.bo += w * b;
    sums.as += w * by_share * a;
    sums.bs += w * by_share * b;
  }
  poses.add_to(tree);
}

void ScanFrameEquations::add_joints(const HandPose& pose, const ScanModel& model,
                                    const std::array<JointLimits, kSegmentCount>& limits, GaussianTree& tree) {
  const auto beyond = [](double x, double lo, double hi) { return x < lo ? x - lo : (x > hi ? x - hi : 0.0); };
  const double w_gap = 1 / sq(kSigmaGap);
  for (int s = 1; s < kSegmentCount; ++s) {
    const SE3 &parent = pose[parent_of(s)], &child = pose[s];
    const Vector3d lever_parent = parent.R * model.in_parent[s], lever_child = child.R * model.in_segment[s];
    const Vector3d gap = parent.t + lever_parent - child.t - lever_child;
    const Eigen::Matrix<double, 3, 6> J_parent = point_jacobian(lever_parent), J_child = -point_jacobian(lever_child);
    const Eigen::Matrix<double, 3, 6> J = (Eigen::Matrix<double, 3, 6>() << parent.R, -child.R).finished();
    tree.add<3>(s, J_child, J_parent, gap, w_gap * Matrix3d::Identity());
    joints_[s] = {w_gap * J.transpose() * J, -w_gap * J.transpose() * gap};
    joint_parent_[s] = w_gap * J_parent.transpose() * J;
    joint_child_[s] = w_gap * J_child.transpose() * J;

    const JointLinearisation joint = linearise_joint(model.profile, pose, s);
    const JointJacobians J_angles = joint.of_angles(), J_turn = joint.of_turn();
    const JointLimits& limit = limits[s];
    const Vector3d excess(beyond(joint.angles.flexion, limit.flexion_lo, limit.flexion_hi),
                          beyond(joint.angles.abduction, limit.abduction_lo, limit.abduction_hi), joint.angles.twist);
    const Vector3d counts(excess[0] != 0, excess[1] != 0, 1);
    tree.add<3>(s, J_angles.child, J_angles.parent, excess, Matrix3d(counts.asDiagonal()) / sq(kSigmaAngle));
    tree.add<3>(s, J_turn.child, J_turn.parent, Vector3d::Zero(), Matrix3d::Identity() / sq(kSigmaTurn));
  }
}

void ScanFrameEquations::couple(const ScanModel& model, const ScanVariables& variables) {
  columns_.clear();
  for (int k = 0; k < ScanVariables::kJoints; ++k) columns_.push_back(k);
  for (const VertexSums& sums : sums_) {
    columns_.push_back(sums.offset);
    if (sums.share >= 0) columns_.push_back(sums.share);
  }
  coupling_.setZero(kPose, static_cast<Eigen::Index>(columns_.size()));
  for (int s = 1; s < kSegmentCount; ++s) {
    coupling_.block<6, 6>(6 * parent_of(s), variables.joint(s)) += joint_parent_[s];
    coupling_.block<6, 6>(6 * s, variables.joint(s)) += joint_child_[s];
  }
  Eigen::Index column = ScanVariables::kJoints;
  for (const VertexSums& sums : sums_) {
    const SkinVertex& v = model.skin.vertices[sums.vertex];
    coupling_.col(column).segment<6>(6 * v.a) += sums.ao;
    coupling_.col(column++).segment<6>(6 * v.b) += sums.bo;
    if (sums.share < 0) continue;
    coupling_.col(column).segment<6>(6 * v.a) += sums.as;
    coupling_.col(column++).segment<6>(6 * v.b) += sums.bs;
  }
}

bool ScanFrameEquations::eliminate_pose(const GaussianTree& tree, bool hold_pose) {
  Eigen::MatrixXd H = dense(tree);
  H.diagonal() *= 1 + kDamping;
  H.diagonal().array() += hold_pose ? kHeld : 1e-3;
  g_pose_.resize(kPose);
  for (int s = 0; s < kSegmentCount; ++s) g_pose_.segment<6>(6 * s) = tree.g[s];
  pose_.compute(H);
  if (pose_.info() != Eigen::Success) return false;
  const Eigen::MatrixXd half = pose_.matrixL().solve(coupling_);
  const Eigen::VectorXd half_g = pose_.matrixL().solve(g_pose_);
  explained_.setZero(half.cols(), half.cols());
  explained_.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose());
  g_explained_ = half.transpose() * half_g;
  return explained_.allFinite();
}

void ScanFrameEquations::add_to(ScanEquations& equations, double weight) {
  for (int s = 1; s < kSegmentCount; ++s) {
    const int first = 6 * (s - 1);
    equations.H.block<6, 6>(first, first) += weight * joints_[s].H;
    equations.g.segment<6>(first) += weight * joints_[s].g;
  }
  for (const VertexSums& sums : sums_) {
    equations.add(sums.offset, sums.offset, weight * sums.oo);
    equations.g[sums.offset] += weight * sums.g_o;
    if (sums.share < 0) continue;
    equations.add(sums.share, sums.share, weight * sums.ss);
    equations.add(sums.share, sums.offset, weight * sums.os);
    equations.g[sums.share] += weight * sums.g_s;
  }
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    equations.g[columns_[j]] -= weight * g_explained_[static_cast<Eigen::Index>(j)];
    for (std::size_t i = j; i < columns_.size(); ++i)
      equations.add(columns_[i], columns_[j],
                    -weight * explained_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  }
  explained_.resize(0, 0);
}

HandPose ScanFrameEquations::moved(const HandPose& pose, const Eigen::VectorXd& step) const {
  Eigen::VectorXd shared(static_cast<Eigen::Index>(columns_.size()));
  for (std::size_t i = 0; i < columns_.size(); ++i) shared[static_cast<Eigen::Index>(i)] = step[columns_[i]];
  const Eigen::VectorXd twists = pose_.solve(g_pose_ - coupling_ * shared);
  HandPose result;
  for (int s = 0; s < kSegmentCount; ++s) {
    const Vector6d twist = twists.segment<6>(6 * s);
    const double scale = std::min({1.0, kLongestStep / std::max(twist.head<3>().norm(), 1e-12),
                                   kLargestTurn / std::max(twist.tail<3>().norm(), 1e-12)});
    result[s] = boxplus(pose[s], scale * twist);
    result[s].R = orthonormalised(result[s].R);
  }
  return result;
}

}  // namespace barehand
