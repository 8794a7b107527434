#pragma once

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <vector>

#include "hand/gaussian_tree.h"
#include "hand/joint_angles.h"
#include "observe/dense/model_comparison.h"
#include "person/scan_model.h"

namespace barehand {

// Normal equations of a scan: those of the shared unknowns, and those of one frame.

/// One frame of a scan: its observation and the pose of the model's segments in it.
struct ScanFrame {
  HandObservationPtr observation;
  HandPose pose;  ///< T_camera_segment
};

/// Information that effectively fixes an unknown.
inline constexpr double kFixedInformation = 1e12;

/// Normal equations H x = g of the unknowns that all frames of a scan share (ScanVariables). Each term involves only
/// few unknowns, so H is kept as triplets; the exceptions are means over the skin of a bone, which are kept in
/// factored form.
struct ScanEquations {
  std::vector<Eigen::Triplet<double>> H;  ///< lower triangle; entries at the same place add up
  /// Jacobian J of the terms that involve many unknowns; J^T J is part of the matrix, too.
  std::vector<Eigen::Triplet<double>> means;
  int mean_rows = 0;  ///< number of rows of J
  Eigen::VectorXd g;

  /// Removes all terms; `count`: number of unknowns.
  void set_zero(int count);
  void add(int i, int j, double value) { H.emplace_back(std::max(i, j), std::min(i, j), value); }
  /// Adds a symmetric block on the diagonal, beginning at the unknown `first`.
  template <int N>
  void add(int first, const Eigen::Matrix<double, N, N>& block) {
    for (int i = 0; i < N; ++i)
      for (int j = 0; j <= i; ++j) add(first + i, first + j, block(i, j));
  }
};

/// The normal equations of one frame: of its pose (96 numbers) and of the shared unknowns that it touches. The pose is
/// eliminated by a Schur complement, so that only evidence that a change of the pose could not explain as well affects
/// the shared unknowns.
class ScanFrameEquations {
 public:
  /// Linearises the frame at its pose and at `model`. `hold_pose`: the frame's pose is taken as correct. `limits`:
  /// joint limits [rad]. Returns false if the equations of the pose are not positive definite.
  bool linearise(const ScanFrame& frame, const ScanModel& model, const ScanVariables& variables,
                 const std::array<JointLimits, kSegmentCount>& limits, bool hold_pose);
  /// Adds `weight` times the equations of the shared unknowns, without the part that explained() returns.
  void add_to(ScanEquations& equations, double weight = 1) const;
  /// H_explained times x, where H_explained is what the elimination of the frame's pose subtracts from the matrix of
  /// the shared unknowns (Schur complement). It is dense and never formed.
  Eigen::VectorXd explained(const Eigen::VectorXd& x) const;
  /// The block of H_explained that belongs to the joints; kJoints x kJoints.
  Eigen::MatrixXd explained_joints() const;
  /// The optimal pose after the shared unknowns have made the step `step`.
  HandPose moved(const HandPose& pose, const Eigen::VectorXd& step) const;

  /// Sum of the squared distances of data and skin along the normal [m^2], over the residuals() that were used.
  double squares() const { return squares_; }
  int residuals() const { return residuals_; }

 private:
  static constexpr int kPose = 6 * kSegmentCount;
  using PoseColumn = Eigen::Matrix<double, 6, 1>;
  // Sums over the residuals at one vertex: information products and gradients of its unknowns, the offset (o) and the
  // skinning weight (s), and their products with the twists of its two segments (a, b).
  struct VertexSums {
    int vertex, offset, skin_weight;  // offset, skin_weight: indices of the unknowns
    double oo = 0, os = 0, ss = 0, g_o = 0, g_s = 0;
    PoseColumn ao = PoseColumn::Zero(), bo = PoseColumn::Zero(), as = PoseColumn::Zero(), bs = PoseColumn::Zero();
  };
  static constexpr int kJoint = ScanVariables::kJoint;
  // Sums over the residuals of one joint with respect to its unknowns.
  struct JointSums {
    Eigen::Matrix<double, kJoint, kJoint> H;
    Eigen::Matrix<double, kJoint, 1> g;
    Eigen::Matrix<double, 6, kJoint> parent, child;  // products with the twists of the joint's two segments
  };

  void add_skin(const ScanFrame& frame, const ScanModel& model, const ScanVariables& variables, GaussianTree& tree);
  void add_joints(const HandPose& pose, const ScanModel& model, const std::array<JointLimits, kSegmentCount>& limits,
                  GaussianTree& tree);
  void couple(const ScanModel& model, const ScanVariables& variables);
  bool factorise_pose(const GaussianTree& tree, bool hold_pose);

  std::vector<VertexSums> sums_;
  std::array<JointSums, kSegmentCount> joints_;
  Eigen::SparseMatrix<double> coupling_;  // rows: pose; columns: shared unknowns
  // Factorised matrix of the frame's pose.
  Eigen::LLT<Eigen::MatrixXd> pose_;
  Eigen::VectorXd g_pose_;
  double squares_ = 0;
  int residuals_ = 0;
};

}  // namespace barehand
