#include "person/scan_equations.h"

#include <algorithm>

#include "hand/joint_linearisation.h"
#include "math/angles.h"
#include "math/square.h"
#include "stages/refinement/residual_moments.h"

namespace barehand {
namespace {

// Builds the normal equations of one frame of a scan from skin distances and joints.

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

// Standard deviations of single residuals. A frame has thousands of them, whose errors are correlated.
constexpr double kSigmaSkin = 0.00045;         // part of a surface distance that is due to the skin's shape [m]
constexpr double kSigmaNoise = 2;              // part that is due to the sensor, in units of the sensor's noise
constexpr double kSigmaGap = 0.00011;          // joint gap (paper, Eq. 5) [m]
constexpr double kSigmaAngle = 0.6 * kDegree;  // angles beyond the limits, and twist (paper, Eq. 6)
constexpr double kSigmaTurn = 4.5 * kDegree;   // rotation of a joint in one step, so that a hidden joint stays in place

// Geman-McClure scale of surface distances, composed like their standard deviation.
constexpr double kRobustSkin = 0.001;  // part that is due to the skin's shape [m]
constexpr double kRobustNoise = 2;     // part that is due to the sensor, relative to the sensor's noise

// Strength of fold_penalty(): with 10, a skinning weight of 0.1 halves the information and one of 0.5 leaves 1 / 26.
constexpr double kFolds = 10;
// Strength of fold_penalty() between palm and fingers: the webs of skin there move with more than two bones, so that
// the skin model, which blends two segments, is less accurate.
constexpr double kKnuckleFolds = 30;

constexpr float kGate = 0.012f;         // larger surface distances are outliers [m]
constexpr float kFacing = 0.3f;         // smallest cosine of the viewing angle: grazing skin is not measured well
constexpr double kDamping = 1e-3;       // Levenberg-Marquardt damping, relative to the diagonal
constexpr double kLongestStep = 0.010;  // largest shift of a segment in one step [m]
constexpr double kLargestTurn = 17 * kDegree;  // largest rotation of a segment in one step

// Whether the vertex lies between the palm and a finger. The thumb is excluded, since it moves freely about its root.
bool at_knuckle(const SkinVertex& v) {
  if (v.a != kPalm && v.b != kPalm) return false;
  return (v.a == kPalm ? v.b : v.a) != segment_of(0, 0);
}

// The normal equations of a pose as a dense matrix.
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
  H.clear();
  means.clear();
  mean_rows = 0;
  g.setZero(count);
}

bool ScanFrameEquations::linearise(const ScanFrame& frame, const ScanModel& model, const ScanVariables& variables,
                                   const std::array<JointLimits, kSegmentCount>& limits, bool hold_pose) {
  GaussianTree tree;
  tree.set_zero();
  add_skin(frame, model, variables, tree);
  add_joints(frame.pose, model, limits, tree);
  couple(model, variables);
  return factorise_pose(tree, hold_pose);
}

void ScanFrameEquations::add_skin(const ScanFrame& frame, const ScanModel& model, const ScanVariables& variables,
                                  GaussianTree& tree) {
  const ComparisonParams params;
  const HandObservation& observation = *frame.observation;

  // Find the correspondences of data and skin.
  RenderedHand rendered;
  ModelComparison comparison;
  render_hand(model.skin, frame.pose, observation.frame->camera, grid_of(observation, params.stride), rendered);
  compare(observation, model.skin, frame.pose, rendered, params, comparison);

  // Clear the frame's earlier sums.
  std::vector<int> slot(model.skin.vertices.size(), -1);  // for each vertex its index in sums_, or -1
  sums_.clear();
  squares_ = 0;
  residuals_ = 0;

  // Set the noise of the residuals, and prepare the sums over the pose.
  const double sigma_sq = square(kSigmaSkin) + square(kSigmaNoise * observation.noise);
  const double robust_sq = square(kRobustSkin) + square(kRobustNoise * observation.noise);
  const bool joints_move = !model.joints_are_known();
  ResidualMoments poses(frame.pose);

  // Use only skin that faces the camera and is near the data.
  for (const Correspondence& c : comparison.correspondences) {
    const float r = c.normal.dot(c.model - c.data);
    if (c.kind != Correspondence::Kind::surface || std::abs(r) > kGate) continue;
    if (-c.model.normalized().dot(c.normal) < kFacing) continue;
    const SkinVertex& v = model.skin.vertices[c.vertex];
    // Give vertices near joints less weight: skin folds and bulges there in the same way in all frames, and this error
    // would shift the estimated joints.
    const double folds = joints_move && at_knuckle(v) ? kKnuckleFolds : kFolds;
    const double w = c.weight / sigma_sq * square(robust_sq / (robust_sq + square(r))) / fold_penalty(v, folds);
    poses.add(v, c.model, c.normal, r, static_cast<float>(w));

    squares_ += square(r);
    ++residuals_;

    // Find the sums of the vertex, or create them at its first residual.
    if (slot[c.vertex] < 0) {
      slot[c.vertex] = static_cast<int>(sums_.size());
      sums_.push_back({c.vertex, variables.offset(c.vertex), variables.skin_weight(c.vertex)});
    }
    VertexSums& sums = sums_[slot[c.vertex]];

    // Differentiate the residual with respect to the vertex's skinning weight for its second segment and the
    // twists of its two segments.
    const auto posed = [&](int s, const Vector3f& p) -> Vector3d { return frame.pose[s] * p.cast<double>(); };
    const Vector3d normal = c.normal.cast<double>(), model_point = c.model.cast<double>();
    const double by_weight = normal.dot(posed(v.b, v.in_b) - posed(v.a, v.in_a));

    // A twist of a segment moves the vertex in proportion to the segment's skinning weight.
    const auto twist = [&](int s, double skin_weight) {
      PoseColumn column;
      column.head<3>() = skin_weight * normal;
      column.tail<3>() = skin_weight * (model_point - frame.pose[s].t).cross(normal);
      return column;
    };
    const PoseColumn a = twist(v.a, 1 - v.weight_b), b = twist(v.b, v.weight_b);

    // Add the residual to the vertex's sums. The derivative with respect to its offset is 1.
    sums.oo += w;
    sums.os += w * by_weight;
    sums.ss += w * square(by_weight);
    sums.g_o -= w * r;
    sums.g_s -= w * by_weight * r;
    sums.ao += w * a;
    sums.bo += w * b;
    sums.as += w * by_weight * a;
    sums.bs += w * by_weight * b;
  }

  // Add the sums of the poses to the tree.
  poses.add_to(tree);
}

void ScanFrameEquations::add_joints(const HandPose& pose, const ScanModel& model,
                                    const std::array<JointLimits, kSegmentCount>& limits, GaussianTree& tree) {
  const double w_gap = 1 / square(kSigmaGap);

  // Add the penalty for the gap between the two points of each joint (paper, Eq. 5).
  for (int s = 1; s < kSegmentCount; ++s) {
    const JointLinearisation joint = linearise_joint({model.rest[s], model.in_parent[s]}, pose, s);
    const Matrix3d &R_parent = pose[parent_of(s)].R, &R_child = pose[s].R;
    const Vector3d lever_child = R_child * model.in_segment[s], gap = joint.gap - lever_child;
    const Eigen::Matrix<double, 3, 6> J_parent = point_jacobian(joint.lever), J_child = -point_jacobian(lever_child);
    const Eigen::Matrix<double, 3, 6> J = (Eigen::Matrix<double, 3, 6>() << R_parent, -R_child).finished();

    tree.add<3>(s, J_child, J_parent, gap, w_gap * Matrix3d::Identity());

    // Add the gap's residuals as functions of the joint's unknowns, and their products with the pose.
    JointSums& sums = joints_[s];
    sums.H.setZero();
    sums.H.topLeftCorner<6, 6>() = w_gap * J.transpose() * J;
    sums.g.head<6>() = -w_gap * J.transpose() * gap;
    sums.parent.leftCols<6>() = w_gap * J_parent.transpose() * J;
    sums.child.leftCols<6>() = w_gap * J_child.transpose() * J;

    // Add the penalty for angles beyond the limits and for any twist (paper, Eq. 6). The small information of every
    // rotation keeps a hidden joint in place.
    const JointJacobians J_angles = joint.of_angles(), J_turn = joint.of_turn();
    const AngleExcess excess = joint.excess(limits[s]);
    const Matrix3d W = Matrix3d(excess.counts.asDiagonal()) / square(kSigmaAngle);
    const Matrix3d J_rest = -joint.d_angles;  // a rotation of the rest pose reduces the joint's angles
    tree.add<3>(s, J_angles.child, J_angles.parent, excess.angles, W);

    sums.H.bottomRightCorner<3, 3>() = J_rest.transpose() * W * J_rest;
    sums.g.tail<3>() = -J_rest.transpose() * (W * excess.angles);
    sums.parent.rightCols<3>() = J_angles.parent.transpose() * W * J_rest;
    sums.child.rightCols<3>() = J_angles.child.transpose() * W * J_rest;
    tree.add<3>(s, J_turn.child, J_turn.parent, Vector3d::Zero(), Matrix3d::Identity() / square(kSigmaTurn));
  }
}

void ScanFrameEquations::couple(const ScanModel& model, const ScanVariables& variables) {
  // Each unknown is coupled with the six numbers of a segment's twist.
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int segment, int unknown, const PoseColumn& column) {
    for (int i = 0; i < 6; ++i) entries.emplace_back(6 * segment + i, unknown, column[i]);
  };

  // Joints are coupled with both of their segments.
  for (int s = 1; s < kSegmentCount; ++s)
    for (int k = 0; k < kJoint; ++k) {
      add(parent_of(s), ScanVariables::joint(s) + k, joints_[s].parent.col(k));
      add(s, ScanVariables::joint(s) + k, joints_[s].child.col(k));
    }

  // A vertex's offset and skinning weight are coupled with both segments that carry it.
  for (const VertexSums& sums : sums_) {
    const SkinVertex& v = model.skin.vertices[sums.vertex];
    add(v.a, sums.offset, sums.ao);
    add(v.b, sums.offset, sums.bo);
    add(v.a, sums.skin_weight, sums.as);
    add(v.b, sums.skin_weight, sums.bs);
  }

  // Build the sparse matrix of the couplings.
  coupling_.resize(kPose, variables.count());
  coupling_.setFromTriplets(entries.begin(), entries.end());
}

bool ScanFrameEquations::factorise_pose(const GaussianTree& tree, bool hold_pose) {
  Eigen::MatrixXd H = dense(tree);
  H.diagonal() *= 1 + kDamping;
  H.diagonal().array() += hold_pose ? kFixedInformation : 1e-3;
  g_pose_.resize(kPose);
  for (int s = 0; s < kSegmentCount; ++s) g_pose_.segment<6>(6 * s) = tree.g[s];
  pose_.compute(H);
  return pose_.info() == Eigen::Success && g_pose_.allFinite();
}

void ScanFrameEquations::add_to(ScanEquations& equations, double weight) const {
  // Add the equations of the joints.
  for (int s = 1; s < kSegmentCount; ++s) {
    const int first = ScanVariables::joint(s);
    equations.add<kJoint>(first, weight * joints_[s].H);
    equations.g.segment<kJoint>(first) += weight * joints_[s].g;
  }

  // Add the equations of the vertices.
  for (const VertexSums& sums : sums_) {
    equations.add(sums.offset, sums.offset, weight * sums.oo);
    equations.g[sums.offset] += weight * sums.g_o;
    equations.add(sums.skin_weight, sums.skin_weight, weight * sums.ss);
    equations.add(sums.skin_weight, sums.offset, weight * sums.os);
    equations.g[sums.skin_weight] += weight * sums.g_s;
  }

  // Subtract the part of the gradient that a change of the pose explains (Schur complement).
  equations.g -= weight * (coupling_.transpose() * pose_.solve(g_pose_));
}

Eigen::VectorXd ScanFrameEquations::explained(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd by_pose = pose_.solve(coupling_ * x);
  return coupling_.transpose() * by_pose;
}

Eigen::MatrixXd ScanFrameEquations::explained_joints() const {
  const Eigen::MatrixXd coupling = coupling_.leftCols(ScanVariables::kJoints);
  return coupling.transpose() * pose_.solve(coupling);
}

HandPose ScanFrameEquations::moved(const HandPose& pose, const Eigen::VectorXd& step) const {
  const Eigen::VectorXd twists = pose_.solve(g_pose_ - coupling_ * step);
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
