#pragma once

#include <Eigen/SparseCholesky>
#include <optional>
#include <span>

#include "core/parallel.h"
#include "stages/refinement/scan_equations.h"

namespace barehand {

/// Equations of a scan's shared unknowns with the poses of all frames eliminated. That makes the matrix dense, so it is
/// never formed: conjugate gradients need its products only, and few of them, as all that no pose touches is solved
/// exactly in each (the preconditioner). Same equations, same solution, whatever the number of threads.
class ScanSystem {
 public:
  /// `equations`: all but what the poses of `frames` explain, with the same `weight`. `frames` and `workers` outlive
  /// it.
  ScanSystem(const ScanEquations& equations, std::span<const ScanFrameEquations> frames, double weight,
             Workers& workers);

  /// The matrix times x.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;
  /// none: the matrix is not positive definite.
  std::optional<Eigen::VectorXd> solve() const;

 private:
  Eigen::VectorXd preconditioned(const Eigen::VectorXd& r) const;

  std::span<const ScanFrameEquations> frames_;
  const double weight_;
  Workers& workers_;
  Eigen::VectorXd g_;
  Eigen::SparseMatrix<double> H_, means_;  // H_: lower triangle
  Eigen::LLT<Eigen::MatrixXd> joints_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> skin_;  // of the other unknowns, and of the means
};

}  // namespace barehand
