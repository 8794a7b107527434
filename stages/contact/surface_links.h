#pragma once

#include <vector>

#include "math/disjoint_sets.h"
#include "stages/contact/surface_cells.h"

namespace barehand {

/// Joins the connected surfaces of a frame that are a finger's width apart or less: a hand covers parts of what it
/// holds. An object is not joined to the table it stands on. Reuses its memory.
class SurfaceLinks {
 public:
  /// `open`: whether each component continues out of view.
  void link(const std::vector<bool>& open, const std::vector<SurfacePoint>& points);
  /// The first of the components that are joined with this one.
  std::int32_t root(std::int32_t component) { return sets_.root(component); }
  /// Whether a component continues out of view, or is a piece of something that does.
  bool open(std::int32_t component) const { return open_[component]; }
  std::int32_t components() const { return static_cast<std::int32_t>(sets_.size()); }

 private:
  /// An occupied voxel with a component in it, and one of the points there.
  struct Voxel {
    std::uint64_t key = 0;
    std::int32_t component = 0;
    const SurfacePoint* point = nullptr;
  };

  void list_voxels(const std::vector<SurfacePoint>& points);
  void find_pieces(const std::vector<bool>& open);
  template <class Act>
  void for_neighbours(const Act& act) const;

  DisjointSets sets_;          // components that belong to one object
  std::vector<Voxel> voxels_;  // sorted by key, then by component
  std::vector<bool> open_;
  std::vector<int> flush_;  // for each component: places where it is flush with an open one, minus the other places
};

}  // namespace barehand
