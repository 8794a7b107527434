#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/parallel.h"

namespace barehand {

/// -log psi (Eq. 4) of every pair of samples of a child and its parent; >= 0.
struct EdgeEnergy {
  std::size_t parents = 0, children = 0;  ///< number of samples
  std::vector<float> value;               ///< row-major: one row per child sample, contiguous over parent samples
  const float* row(std::size_t child) const { return value.data() + child * parents; }
};

/// Sum-product gives posterior marginals, max-product max-marginals (its best states form the best configuration).
enum class Marginals { sum, max };

/// Exact belief propagation on a tree (Eq. 7, 8) in the log domain, so that nothing under- or overflows.
/// parent[i] < i is node i's parent, -1 for node 0. log_phi[i][k]: log observation of node i's sample k, finite.
/// energy[i]: of the edge from i to its parent; energy[0] is unused. At least one sample per node.
/// Returns log beliefs, normalised so that their exponentials sum to 1. Same result for any number of workers.
std::vector<std::vector<double>> tree_beliefs(std::span<const int> parent, std::span<const std::vector<double>> log_phi,
                                              std::span<const EdgeEnergy> energy, Marginals marginals,
                                              Workers& workers);

}  // namespace barehand
