#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/parallel/parallel.h"

namespace barehand {

// Belief propagation on the tree of segments.

/// -log psi (paper, Eq. 4), >= 0, of all pairs of a child's and its parent's samples.
struct EdgeEnergy {
  std::size_t parents = 0, children = 0;  ///< numbers of samples
  std::vector<float> value;               ///< row-major: one row per child sample, contiguous over parent samples
  const float* row(std::size_t child) const { return value.data() + child * parents; }
};

/// Which messages are passed: sum-product ones yield the posterior marginals, max-product ones the max-marginals, whose
/// best states together form the most likely configuration.
enum class Marginals { sum, max };

/// Exact belief propagation on a tree (paper, Eq. 7, 8), in the log domain to avoid underflow and overflow. An object
/// keeps its buffers between calls but no other state.
class BeliefPropagation {
 public:
  /// parent[i] < i is the parent of node i; parent[0] = -1.
  explicit BeliefPropagation(std::span<const int> parent);

  /// Computes the belief of every node. log_phi[i][k]: log of the observation potential phi of sample k of node i,
  /// which must be finite; at least one sample per node. energy[i]: the edge from i to its parent; energy[0] is unused.
  /// `log_beliefs`: one list per node, normalised so that the exponentials sum to 1. The result does not depend on the
  /// number of workers.
  void run(std::span<const std::vector<double>> log_phi, std::span<const EdgeEnergy> energy, Marginals marginals,
           Workers& workers, std::span<std::vector<double>> log_beliefs);

 private:
  // The arguments of run().
  struct Input {
    std::span<const std::vector<double>> log_phi;
    std::span<const EdgeEnergy> energy;
    Marginals marginals;
  };
  /// A message along an edge in one direction, and the buffers to compute it.
  struct Message {
    std::vector<double> log, evidence;
    std::vector<float> relative, best, sum;
  };
  void gather(const Input& input, int node, int without, bool with_parent, std::vector<double>& evidence) const;
  void send_up(const Input& input, int node);
  void send_down(const Input& input, int node);

  std::vector<int> parent_;
  /// The children of each node, and the nodes of each depth, whose messages do not depend on each other.
  std::vector<std::vector<int>> children_, layers_;
  std::vector<Message> up_, down_;  ///< messages from node i to its parent, and from its parent to node i
};

}  // namespace barehand
