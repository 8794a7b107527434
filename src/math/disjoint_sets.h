#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace barehand {

/// Disjoint sets of members that are numbered from 0 (union-find). A set's root is its smallest member. Reuses its
/// memory.
class DisjointSets {
 public:
  void clear() { parent_.clear(); }
  std::size_t size() const { return parent_.size(); }
  /// Adds a member in a set of its own, and returns its number.
  std::int32_t add() {
    parent_.push_back(static_cast<std::int32_t>(parent_.size()));
    return parent_.back();
  }
  std::int32_t root(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Joins the sets of two members, and returns the root.
  std::int32_t join(std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    return parent_[high] = low;
  }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace barehand
