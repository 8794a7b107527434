#include "person/scan_system.h"

#include <utility>

namespace barehand {
namespace {

// Solves the equations of a scan by preconditioned conjugate gradients.

constexpr double kScanDamping = 1e-3;  // Levenberg-Marquardt damping, relative to the diagonal
constexpr double kTolerance = 1e-6;    // size of the final residual, relative to the right-hand side
constexpr int kMostIterations = 1000;  // about a hundred are usual
constexpr int kJoints = ScanVariables::kJoints;

Eigen::SparseMatrix<double> assembled(int rows, int columns, const std::vector<Eigen::Triplet<double>>& entries) {
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// The matrix H + J^T J of the skin's unknowns in the augmented form [H J^T; J -1], which has the same solution and
/// stays sparse.
Eigen::SparseMatrix<double> augmented(const Eigen::SparseMatrix<double>& H, const Eigen::SparseMatrix<double>& means) {
  const int skin = static_cast<int>(H.rows()) - kJoints, rows = static_cast<int>(means.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = kJoints; column < H.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(H, column); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()) - kJoints, column - kJoints, it.value());
    for (Eigen::SparseMatrix<double>::InnerIterator it(means, column); it; ++it)
      entries.emplace_back(skin + static_cast<int>(it.row()), column - kJoints, it.value());
  }
  for (int row = 0; row < rows; ++row) entries.emplace_back(skin + row, skin + row, -1.0);
  return assembled(skin + rows, skin + rows, entries);
}

}  // namespace

ScanSystem::ScanSystem(const ScanEquations& equations, std::span<const ScanFrameEquations> frames, double weight,
                       Workers& workers, std::stop_token stop)
    : frames_(frames), weight_(weight), workers_(workers), stop_(std::move(stop)), g_(equations.g) {
  // Assemble the sparse matrices.
  const int count = static_cast<int>(g_.size());
  H_ = assembled(count, count, equations.H);
  means_ = assembled(equations.mean_rows, count, equations.means);

  // Compute the joints' block with the poses eliminated, for the preconditioner.
  Eigen::MatrixXd joints = Eigen::MatrixXd(H_.topLeftCorner(kJoints, kJoints)).selfadjointView<Eigen::Lower>();
  for (const ScanFrameEquations& frame : frames_) joints -= weight_ * frame.explained_joints();

  // For the joints, the damping is relative to what the elimination leaves of their equations, because the poses
  // explain nearly all of them.
  Eigen::VectorXd damping = kScanDamping * H_.diagonal();
  damping.head(kJoints) = kScanDamping * joints.diagonal();
  H_ += Eigen::SparseMatrix<double>(damping.asDiagonal());  // damps unknowns that no frame determines, too

  joints.diagonal() += damping.head(kJoints);
  joints_.compute(joints);

  // Factorise the block of the skin, which takes long.
  if (stop_.stop_requested()) return;
  const Eigen::SparseMatrix<double> skin = augmented(H_, means_);
  if (stop_.stop_requested()) return;
  skin_.analyzePattern(skin);
  if (!stop_.stop_requested()) skin_.factorize(skin);
}

Eigen::VectorXd ScanSystem::times(const Eigen::VectorXd& x) const {
  std::vector<Eigen::VectorXd> explained(frames_.size());
  workers_.for_each_index(static_cast<int>(frames_.size()), [&](int i) { explained[i] = frames_[i].explained(x); });
  Eigen::VectorXd y = H_.selfadjointView<Eigen::Lower>() * x;
  y += means_.transpose() * (means_ * x);
  for (const Eigen::VectorXd& e : explained) y -= weight_ * e;
  return y;
}

Eigen::VectorXd ScanSystem::preconditioned(const Eigen::VectorXd& r) const {
  Eigen::VectorXd z(r.size());
  z.head(kJoints) = joints_.solve(r.head(kJoints));
  const Eigen::Index skin = r.size() - kJoints;
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(skin + means_.rows());
  rhs.head(skin) = r.tail(skin);
  z.tail(skin) = skin_.solve(rhs).head(skin);
  return z;
}

std::optional<Eigen::VectorXd> ScanSystem::solve() const {
  // Start the preconditioned conjugate gradients at zero.
  if (stop_.stop_requested() || joints_.info() != Eigen::Success || skin_.info() != Eigen::Success) return std::nullopt;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(g_.size()), r = g_, z = preconditioned(r), direction = z;
  double size = r.dot(z);
  const double enough = kTolerance * kTolerance * size;

  // Step along conjugate directions until the residual is small enough.
  for (int i = 0; i < kMostIterations && size > enough; ++i) {
    if (stop_.stop_requested()) return std::nullopt;
    const Eigen::VectorXd product = times(direction);
    const double curvature = direction.dot(product);
    if (!(curvature > 0)) return std::nullopt;

    const double step = size / curvature;
    x += step * direction;
    r -= step * product;
    z = preconditioned(r);
    const double next = r.dot(z);
    direction = z + next / size * direction;
    size = next;
  }

  if (!x.allFinite()) return std::nullopt;
  return x;
}

}  // namespace barehand
