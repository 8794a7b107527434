#pragma once

#include <Eigen/SparseCholesky>
#include <optional>
#include <span>
#include <stop_token>

#include "core/parallel/parallel.h"
#include "person/scan_equations.h"

namespace barehand {

/// Solves the equations of a scan's shared unknowns with the poses of all frames eliminated. The elimination makes the
/// matrix dense, so it is never formed; conjugate gradients need only its products with vectors. They converge in few
/// iterations, because the preconditioner solves exactly everything that no pose touches. The result does not depend
/// on the number of threads.
class ScanSystem {
 public:
  /// `equations`: the shared unknowns' equations before the elimination, to which every one of `frames` was added with
  /// `weight`. `frames` and `workers` must outlive this object. Once `stop` was requested, only solve() may be called.
  ScanSystem(const ScanEquations& equations, std::span<const ScanFrameEquations> frames, double weight,
             Workers& workers, std::stop_token stop = {});

  /// The matrix, with all poses eliminated, times x.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;
  /// The step of all shared unknowns; none if the matrix is not positive definite, or if it is stopped.
  std::optional<Eigen::VectorXd> solve() const;

 private:
  Eigen::VectorXd preconditioned(const Eigen::VectorXd& r) const;

  std::span<const ScanFrameEquations> frames_;
  const double weight_;
  Workers& workers_;
  const std::stop_token stop_;
  Eigen::VectorXd g_;
  Eigen::SparseMatrix<double> H_, means_;  // lower triangle of H, and the Jacobian ScanEquations::means
  Eigen::LLT<Eigen::MatrixXd> joints_;     // preconditioner of the joints
  // Preconditioner of the skin's unknowns, augmented by the means.
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> skin_;
};

}  // namespace barehand
