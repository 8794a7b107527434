#include "stages/fusion/belief_propagation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/random.h"

namespace barehand {
namespace {

using Beliefs = std::vector<std::vector<double>>;

struct SmallTree {
  std::vector<int> parent;
  Beliefs log_phi;
  std::vector<EdgeEnergy> energy;
};

/// A tree of up to 6 nodes with 1 to 4 states each; log observations are in `phi_range`, edge energies in
/// `energy_range`.
SmallTree random_tree(std::uint64_t seed, double phi_range, double energy_range) {
  KeyedRandom random(seed, 7);
  SmallTree tree;
  const int nodes = 2 + static_cast<int>(random.uniform(0, 5));
  for (int i = 0; i < nodes; ++i) {
    tree.parent.push_back(i == 0 ? -1 : static_cast<int>(random.uniform(0, i)));
    tree.log_phi.emplace_back(1 + static_cast<int>(random.uniform(0, 4)));
    for (double& p : tree.log_phi.back()) p = random.uniform(-phi_range, 0);

    // The edge to the parent.
    EdgeEnergy e;
    if (i > 0) {
      e = {tree.log_phi[tree.parent[i]].size(), tree.log_phi[i].size(), {}};
      for (std::size_t k = 0; k < e.parents * e.children; ++k)
        e.value.push_back(static_cast<float>(random.uniform(0, energy_range)));
    }
    tree.energy.push_back(e);
  }
  return tree;
}

double log_add(double a, double b) {
  const double m = std::max(a, b);
  return std::isinf(m) ? m : m + std::log(std::exp(a - m) + std::exp(b - m));
}

/// Marginals or max-marginals, computed by enumerating all joint states.
Beliefs brute_force(const SmallTree& tree, Marginals marginals) {
  Beliefs result;
  for (const auto& phi : tree.log_phi) result.emplace_back(phi.size(), -INFINITY);
  std::vector<std::size_t> state(tree.parent.size(), 0);

  // The log probability of one joint state.
  for (bool more = true; more;) {
    double total = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
      total += tree.log_phi[i][state[i]];
      if (i > 0) total -= tree.energy[i].row(state[i])[state[tree.parent[i]]];
    }

    // Add it to the belief of each node's state.
    for (std::size_t i = 0; i < state.size(); ++i) {
      double& r = result[i][state[i]];
      r = marginals == Marginals::max ? std::max(r, total) : log_add(r, total);
    }

    // The next joint state.
    more = false;
    for (std::size_t i = 0; i < state.size() && !more; ++i) {
      state[i] = (state[i] + 1) % tree.log_phi[i].size();
      more = state[i] != 0;
    }
  }

  // Normalise.
  for (auto& r : result) {
    double sum = -INFINITY;
    for (const double v : r) sum = log_add(sum, v);
    for (double& v : r) v -= sum;
  }
  return result;
}

/// Largest error of a belief. Where the state matters (above e^-20) the logarithms are compared; elsewhere the belief
/// only has to be low.
double mismatch(const Beliefs& actual, const Beliefs& expected) {
  double worst = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (std::size_t k = 0; k < expected[i].size(); ++k) {
      if (!std::isfinite(actual[i][k])) return INFINITY;
      const double floor = -20;
      worst = std::max(worst, std::abs(std::max(actual[i][k], floor) - std::max(expected[i][k], floor)));
    }
  return worst;
}

Beliefs propagate(const SmallTree& t, Marginals marginals = Marginals::sum, int threads = 1) {
  Workers workers(threads);
  Beliefs beliefs(t.parent.size());
  BeliefPropagation(t.parent).run(t.log_phi, t.energy, marginals, workers, beliefs);
  return beliefs;
}

TEST(TreeBeliefs, EqualMarginalsByEnumeration) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const SmallTree tree = random_tree(seed, 5, 5);
    ASSERT_LT(mismatch(propagate(tree), brute_force(tree, Marginals::sum)), 1e-5) << "seed " << seed;
  }
}

TEST(TreeBeliefs, StayExactInExtremeDynamicRange) {
  // exp(-5000) is zero in every floating-point format, so that a message in the linear domain would be 0 / 0 here.
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    for (const auto& [phi, psi] : {std::pair{5000.0, 5.0}, {5.0, 5000.0}, {5000.0, 5000.0}}) {
      const SmallTree tree = random_tree(seed, phi, psi);
      // Near 5000, single precision has a spacing of 5e-4, and several such errors add up along the tree.
      ASSERT_LT(mismatch(propagate(tree), brute_force(tree, Marginals::sum)), 5e-3) << "seed " << seed;
    }
}

TEST(TreeBeliefs, MaxProductEqualsMaxMarginalsByEnumeration) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const SmallTree tree = random_tree(seed, 10, 10);
    ASSERT_LT(mismatch(propagate(tree, Marginals::max), brute_force(tree, Marginals::max)), 1e-5) << "seed " << seed;
  }
}

TEST(TreeBeliefs, SumToOne) {
  for (const auto& belief : propagate(random_tree(3, 50, 50))) {
    double sum = 0;
    for (const double b : belief) sum += std::exp(b);
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(TreeBeliefs, DoNotDependOnTheNumberOfWorkers) {
  const SmallTree tree = random_tree(11, 20, 20);
  EXPECT_EQ(propagate(tree, Marginals::sum, 1), propagate(tree, Marginals::sum, 3));
}

TEST(TreeBeliefs, DoNotDependOnWhatWasComputedBefore) {
  const SmallTree tree = random_tree(12, 20, 20);
  SmallTree larger = tree;  // more samples per node
  for (std::size_t i = 0; i < larger.parent.size(); ++i) {
    larger.log_phi[i].resize(9, -1);
    if (i > 0) larger.energy[i] = {9, 9, std::vector<float>(81, 0.5f)};
  }
  Workers workers(1);
  BeliefPropagation propagation(tree.parent);
  Beliefs beliefs(tree.parent.size());
  propagation.run(larger.log_phi, larger.energy, Marginals::sum, workers, beliefs);
  propagation.run(tree.log_phi, tree.energy, Marginals::sum, workers, beliefs);
  EXPECT_EQ(beliefs, propagate(tree));
}

TEST(TreeBeliefsCheck, RejectsAMessageThatIgnoresASibling) {
  // A root with two leaves. A wrong implementation would leave out the second leaf's message.
  SmallTree tree{{-1, 0, 0}, {{0, 0}, {0, -1}, {-3, 0}}, {{}, {2, 2, {0, 2, 2, 0}}, {2, 2, {0, 2, 2, 0}}}};
  SmallTree without = tree;
  without.log_phi[2] = {0, 0};
  const Beliefs expected = brute_force(tree, Marginals::sum);
  EXPECT_LT(mismatch(propagate(tree), expected), 1e-6);
  EXPECT_GT(mismatch(propagate(without), expected), 0.1);
}

TEST(TreeBeliefsCheck, RejectsATransposedConstraintAndSlightlyWrongEntries) {
  SmallTree tree{{-1, 0}, {{0, -1}, {0, -2}}, {{}, {2, 2, {0, 3, 1, 2}}}};
  const Beliefs expected = brute_force(tree, Marginals::sum);
  SmallTree transposed = tree;
  transposed.energy[1].value = {0, 1, 3, 2};
  EXPECT_GT(mismatch(propagate(transposed), expected), 0.1);
  SmallTree slightly = tree;
  slightly.energy[1].value[3] += 0.001f;
  EXPECT_GT(mismatch(propagate(slightly), expected), 1e-5);
  EXPECT_EQ(mismatch({{NAN, NAN}, {NAN, NAN}}, expected), INFINITY);
}

}  // namespace
}  // namespace barehand
