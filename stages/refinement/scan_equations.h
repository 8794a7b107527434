#pragma once

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <vector>

#include "hand/gaussian_tree.h"
#include "hand/joint_angles.h"
#include "observe/model_comparison.h"
#include "stages/refinement/scan_model.h"

namespace barehand {

/// One frame of a scan: what was seen, and the pose of the model's segments there.
struct ScanFrame {
  HandObservationPtr observation;
  HandPose pose;  ///< T_camera_segment
};

/// Information of what must not move.
inline constexpr double kHeld = 1e12;

/// Normal equations H x = g of a scan's shared unknowns. Few unknowns meet in any one term, but for
/// means over the skin of a bone.
struct ScanEquations {
  std::vector<Eigen::Triplet<double>> H;      ///< lower triangle; entries at the same place add up
  std::vector<Eigen::Triplet<double>> means;  ///< J, of terms that many unknowns share: J^T J belongs to H, too
  int mean_rows = 0;                          ///< of J
  Eigen::VectorXd g;

  void set_zero(int count);
  void add(int i, int j, double value) { H.emplace_back(std::max(i, j), std::min(i, j), value); }
  /// A symmetric block on the diagonal.
  template <int N>
  void add(int first, const Eigen::Matrix<double, N, N>& block) {
    for (int i = 0; i < N; ++i)
      for (int j = 0; j <= i; ++j) add(first + i, first + j, block(i, j));
  }
};

/// What one frame says: normal equations of its pose, 96 numbers, and of the shared unknowns that it touches. The
/// pose is eliminated by a Schur complement, so a joint counts only as far as no pose would explain the frame as well.
class ScanFrameEquations {
 public:
  /// `hold_pose`: the frame's pose is taken as right. false: the equations of the pose are not positive definite.
  bool linearise(const ScanFrame& frame, const ScanModel& model, const ScanVariables& variables,
                 const std::array<JointLimits, kSegmentCount>& limits, bool hold_pose);
  /// `weight` times what the frame says, but for explained().
  void add_to(ScanEquations& equations, double weight = 1) const;
  /// H_explained x: what the frame's pose takes of the shared unknowns' equations. H_explained is dense and never made.
  Eigen::VectorXd explained(const Eigen::VectorXd& x) const;
  /// Its block of the joints.
  Eigen::MatrixXd explained_joints() const;
  /// The pose that is best once the shared unknowns have made `step`.
  HandPose moved(const HandPose& pose, const Eigen::VectorXd& step) const;

  /// Distances of data and skin along the normal that counted [m^2], and how many.
  double squares() const { return squares_; }
  int residuals() const { return residuals_; }

 private:
  static constexpr int kPose = 6 * kSegmentCount;
  using PoseColumn = Eigen::Matrix<double, 6, 1>;
  // Sums over the residuals at one vertex: products of the changes by its offset (o), its share (s) and the poses of
  // its two segments (a, b), and their gradients.
  struct VertexSums {
    int vertex, offset, share;  // the latter two: number of the unknown
    double oo = 0, os = 0, ss = 0, g_o = 0, g_s = 0;
    PoseColumn ao = PoseColumn::Zero(), bo = PoseColumn::Zero(), as = PoseColumn::Zero(), bs = PoseColumn::Zero();
  };
  static constexpr int kJoint = ScanVariables::kJoint;
  struct JointSums {
    Eigen::Matrix<double, kJoint, kJoint> H;
    Eigen::Matrix<double, kJoint, 1> g;
    Eigen::Matrix<double, 6, kJoint> parent, child;  // with the twists of the joint's two segments
  };

  void add_skin(const ScanFrame& frame, const ScanModel& model, const ScanVariables& variables, GaussianTree& tree);
  void add_joints(const HandPose& pose, const ScanModel& model, const std::array<JointLimits, kSegmentCount>& limits,
                  GaussianTree& tree);
  void couple(const ScanModel& model, const ScanVariables& variables);
  bool factorise_pose(const GaussianTree& tree, bool hold_pose);

  std::vector<VertexSums> sums_;
  std::array<JointSums, kSegmentCount> joints_;
  Eigen::SparseMatrix<double> coupling_;  // pose x shared unknowns
  Eigen::LLT<Eigen::MatrixXd> pose_;
  Eigen::VectorXd g_pose_;
  double squares_ = 0;
  int residuals_ = 0;
};

}  // namespace barehand
