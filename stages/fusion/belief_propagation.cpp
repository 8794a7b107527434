// Belief propagation on the tree of segments, with log values in single precision.
#include "stages/fusion/belief_propagation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "math/fast_math.h"

namespace barehand {
namespace {

using Log = std::vector<double>;
constexpr float kLowest = std::numeric_limits<float>::lowest();

/// Shifts log values so that the best one is 0, near which single precision is most accurate. Constant offsets cancel
/// in the paper's Eq. 8.
void relative_to_best(const Log& h, std::vector<float>& relative) {
  const double best = *std::max_element(h.begin(), h.end());
  relative.resize(h.size());
  for (std::size_t i = 0; i < h.size(); ++i) relative[i] = static_cast<float>(h[i] - best);
}

void add(Log& a, const Log& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
}

void normalise(Log& log_belief) {
  const double best = *std::max_element(log_belief.begin(), log_belief.end());
  double sum = 0;
  for (const double b : log_belief) sum += std::exp(b - best);
  for (double& b : log_belief) b -= best + std::log(sum);
}

}  // namespace

BeliefPropagation::BeliefPropagation(std::span<const int> parent)
    : parent_(parent.begin(), parent.end()), children_(parent.size()), up_(parent.size()), down_(parent.size()) {
  // Sort the nodes by depth, and collect the children of each.
  std::vector<std::size_t> depth(parent.size(), 0);
  for (std::size_t i = 0; i < parent.size(); ++i) {
    assert((i == 0) == (parent[i] < 0) && parent[i] < static_cast<int>(i));
    if (i > 0) {
      depth[i] = depth[parent[i]] + 1;
      children_[parent[i]].push_back(static_cast<int>(i));
    }
    if (layers_.size() <= depth[i]) layers_.resize(depth[i] + 1);
    layers_[depth[i]].push_back(static_cast<int>(i));
  }
}

/// Sums log phi and all incoming log messages of a node, except the one from the child `without` and, unless
/// `with_parent`, the one from the parent.
void BeliefPropagation::gather(const Input& input, int node, int without, bool with_parent, Log& evidence) const {
  evidence = input.log_phi[node];
  for (const int k : children_[node])
    if (k != without) add(evidence, up_[k].log);
  if (with_parent && parent_[node] >= 0) add(evidence, down_[node].log);
}

/// The message of the paper's Eq. 7 from a child to its parent.
void BeliefPropagation::send_up(const Input& input, int node) {
  // Gather the child's evidence without the message from its parent.
  Message& m = up_[node];
  const EdgeEnergy& e = input.energy[node];
  gather(input, node, -1, false, m.evidence);
  relative_to_best(m.evidence, m.relative);

  // Find the best sample of the child for each sample of the parent (max-product).
  m.best.assign(e.parents, kLowest);
  const float* from = m.relative.data();
  float* best = m.best.data();
  for (std::size_t c = 0; c < e.children; ++c) {
    const float* row = e.row(c);
    for (std::size_t p = 0; p < e.parents; ++p) {
      const float x = from[c] - row[p];
      best[p] = best[p] > x ? best[p] : x;
    }
  }

  m.log.assign(m.best.begin(), m.best.end());
  if (input.marginals == Marginals::max) return;

  // For sum-product, sum over the child's samples; the largest term is divided out to avoid underflow.
  m.sum.assign(e.parents, 0.0f);
  float* sum = m.sum.data();
  for (std::size_t c = 0; c < e.children; ++c) {
    const float* row = e.row(c);
#pragma omp simd
    for (std::size_t p = 0; p < e.parents; ++p) sum[p] += fast_exp(from[c] - row[p] - best[p]);
  }
  for (std::size_t p = 0; p < e.parents; ++p) m.log[p] += std::log(static_cast<double>(sum[p]));
}

/// The message of the paper's Eq. 7 from a parent to its child.
void BeliefPropagation::send_down(const Input& input, int node) {
  // Gather the parent's evidence without the message from this child.
  Message& m = down_[node];
  const EdgeEnergy& e = input.energy[node];
  gather(input, parent_[node], node, true, m.evidence);
  relative_to_best(m.evidence, m.relative);

  // Compute the maximum or the sum over the parent's samples for each sample of the child.
  m.log.resize(e.children);
  const float* from = m.relative.data();
  for (std::size_t c = 0; c < e.children; ++c) {
    const float* row = e.row(c);
    float best = kLowest;
#pragma omp simd reduction(max : best)
    for (std::size_t p = 0; p < e.parents; ++p) {
      const float x = from[p] - row[p];
      best = best > x ? best : x;
    }

    // Divide the largest term out of the sum to avoid underflow.
    m.log[c] = best;
    if (input.marginals == Marginals::max) continue;

    float sum = 0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t p = 0; p < e.parents; ++p) sum += fast_exp(from[p] - row[p] - best);
    m.log[c] += std::log(static_cast<double>(sum));
  }
}

void BeliefPropagation::run(std::span<const Log> log_phi, std::span<const EdgeEnergy> energy, Marginals marginals,
                            Workers& workers, std::span<Log> log_beliefs) {
  // Messages run from the fingertips to the palm and back, layer by layer.
  const Input input{log_phi, energy, marginals};
  for (std::size_t d = layers_.size() - 1; d > 0; --d)
    workers.for_each_index(static_cast<int>(layers_[d].size()), [&](int k) { send_up(input, layers_[d][k]); });
  for (std::size_t d = 1; d < layers_.size(); ++d)
    workers.for_each_index(static_cast<int>(layers_[d].size()), [&](int k) { send_down(input, layers_[d][k]); });

  // Combine the messages into the beliefs (paper, Eq. 8).
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    gather(input, static_cast<int>(i), -1, true, log_beliefs[i]);
    normalise(log_beliefs[i]);
  }
}

}  // namespace barehand
