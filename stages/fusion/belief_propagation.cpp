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

/// Offsets cancel in Eq. 8; the best state at 0 keeps single precision sharp where it matters.
std::vector<float> relative_to_best(const Log& h) {
  const double best = *std::max_element(h.begin(), h.end());
  std::vector<float> relative(h.size());
  for (std::size_t i = 0; i < h.size(); ++i) relative[i] = static_cast<float>(h[i] - best);
  return relative;
}

/// Eq. 7 from a child, whose gathered log evidence is h, to its parent.
Log message_up(const Log& h, const EdgeEnergy& e, Marginals marginals) {
  const std::vector<float> from = relative_to_best(h);
  std::vector<float> best_and_sum(2 * e.parents, kLowest);
  float *best = best_and_sum.data(), *sum = best + e.parents;
  for (std::size_t c = 0; c < e.children; ++c) {
    const float* row = e.row(c);
    for (std::size_t p = 0; p < e.parents; ++p) {
      const float x = from[c] - row[p];
      best[p] = best[p] > x ? best[p] : x;
    }
  }
  Log message(best, best + e.parents);
  if (marginals == Marginals::max) return message;
  std::fill_n(sum, e.parents, 0.0f);
  for (std::size_t c = 0; c < e.children; ++c) {
    const float* row = e.row(c);
#pragma omp simd
    for (std::size_t p = 0; p < e.parents; ++p) sum[p] += fast_exp(from[c] - row[p] - best[p]);
  }
  for (std::size_t p = 0; p < e.parents; ++p) message[p] += std::log(static_cast<double>(sum[p]));
  return message;
}

/// Eq. 7 from a parent to its child.
Log message_down(const Log& h, const EdgeEnergy& e, Marginals marginals) {
  const std::vector<float> from = relative_to_best(h);
  Log message(e.children);
  for (std::size_t c = 0; c < e.children; ++c) {
    const float* row = e.row(c);
    float best = kLowest;
#pragma omp simd reduction(max : best)
    for (std::size_t p = 0; p < e.parents; ++p) {
      const float x = from[p] - row[p];
      best = best > x ? best : x;
    }
    message[c] = best;
    if (marginals == Marginals::max) continue;
    float sum = 0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t p = 0; p < e.parents; ++p) sum += fast_exp(from[p] - row[p] - best);
    message[c] += std::log(static_cast<double>(sum));
  }
  return message;
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

/// The passes over one tree; nodes of equal depth are independent of each other.
struct Passes {
  std::span<const int> parent;
  std::span<const Log> log_phi;
  std::span<const EdgeEnergy> energy;
  Marginals marginals;
  std::vector<std::vector<int>> children, layers;
  std::vector<Log> up, down;  ///< message from node i to its parent, and from its parent to node i

  void arrange() {
    const std::size_t n = parent.size();
    std::vector<std::size_t> depth(n, 0);
    children.resize(n);
    up.resize(n);
    down.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      assert((i == 0) == (parent[i] < 0) && parent[i] < static_cast<int>(i));
      if (i > 0) {
        depth[i] = depth[parent[i]] + 1;
        children[parent[i]].push_back(static_cast<int>(i));
      }
      if (layers.size() <= depth[i]) layers.resize(depth[i] + 1);
      layers[depth[i]].push_back(static_cast<int>(i));
    }
  }
  /// phi and all incoming messages except those from child `without` and, if !with_parent, from the parent.
  Log evidence(int i, int without, bool with_parent) const {
    Log h = log_phi[i];
    for (const int k : children[i])
      if (k != without) add(h, up[k]);
    if (with_parent && parent[i] >= 0) add(h, down[i]);
    return h;
  }
  void send_up(int i) { up[i] = message_up(evidence(i, -1, false), energy[i], marginals); }
  void send_down(int i) { down[i] = message_down(evidence(parent[i], i, true), energy[i], marginals); }
};

}  // namespace

std::vector<Log> tree_beliefs(std::span<const int> parent, std::span<const Log> log_phi,
                              std::span<const EdgeEnergy> energy, Marginals marginals, Workers& workers) {
  Passes passes{parent, log_phi, energy, marginals, {}, {}, {}, {}};
  passes.arrange();
  const auto& layers = passes.layers;
  for (std::size_t d = layers.size() - 1; d > 0; --d)
    workers.for_each_index(static_cast<int>(layers[d].size()), [&](int k) { passes.send_up(layers[d][k]); });
  for (std::size_t d = 1; d < layers.size(); ++d)
    workers.for_each_index(static_cast<int>(layers[d].size()), [&](int k) { passes.send_down(layers[d][k]); });

  std::vector<Log> beliefs(parent.size());
  for (std::size_t i = 0; i < parent.size(); ++i) {
    beliefs[i] = passes.evidence(static_cast<int>(i), -1, true);  // Eq. 8
    normalise(beliefs[i]);
  }
  return beliefs;
}

}  // namespace barehand
