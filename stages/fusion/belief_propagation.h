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

/// Exact belief propagation on a tree (Eq. 7, 8) in the log domain, so that nothing under- or overflows. Keeps its
/// memory from call to call, and nothing else.
class BeliefPropagation {
 public:
  /// parent[i] < i is node i's parent, -1 for node 0.
  explicit BeliefPropagation(std::span<const int> parent);

  /// log_phi[i][k]: log observation of node i's sample k, finite. energy[i]: of the edge from i to its parent;
  /// energy[0] is unused. At least one sample per node. `log_beliefs`, one a node, are normalised so that their
  /// exponentials sum to 1. Same result for any number of workers.
  void run(std::span<const std::vector<double>> log_phi, std::span<const EdgeEnergy> energy, Marginals marginals,
           Workers& workers, std::span<std::vector<double>> log_beliefs);

 private:
  struct Input {
    std::span<const std::vector<double>> log_phi;
    std::span<const EdgeEnergy> energy;
    Marginals marginals;
  };
  /// Of one edge in one direction, with what it takes to compute it.
  struct Message {
    std::vector<double> log, evidence;
    std::vector<float> relative, best, sum;
  };
  void gather(const Input& input, int node, int without, bool with_parent, std::vector<double>& evidence) const;
  void send_up(const Input& input, int node);
  void send_down(const Input& input, int node);

  std::vector<int> parent_;
  std::vector<std::vector<int>> children_, layers_;  ///< layers: nodes of equal depth, independent of each other
  std::vector<Message> up_, down_;                   ///< from node i to its parent, and from its parent to node i
};

}  // namespace barehand
