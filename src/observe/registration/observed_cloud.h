#pragma once

#include <memory>
#include <vector>

#include "observe/observation.h"

namespace barehand {

/// The hand points of one frame with their normals, indexed for nearest-neighbour search. It refers to the observation:
/// once that is destroyed, only reset() may be called.
class ObservedCloud {
 public:
  ObservedCloud();
  explicit ObservedCloud(const HandObservation& observation);
  ~ObservedCloud();
  ObservedCloud(ObservedCloud&&) noexcept;
  ObservedCloud& operator=(ObservedCloud&&) noexcept;

  /// Loads the points of another frame and reuses the memory.
  void reset(const HandObservation& observation);

  std::size_t size() const;
  bool empty() const { return size() == 0; }
  /// Point `i` in the camera frame [m].
  Eigen::Vector3d point(std::size_t i) const;
  /// Unit normal of point `i`, towards the camera; zero where undefined.
  Eigen::Vector3d normal(std::size_t i) const;
  Eigen::Vector3d centroid() const;
  /// Index of the point nearest to `p`. The cloud must not be empty. Any index is a valid guess; a near one saves most
  /// of the search.
  std::size_t nearest(const Eigen::Vector3d& p, std::size_t guess) const;
  /// Whether an object is in front of `p`, so that the frame does not show whether there is a surface.
  bool hidden(const Eigen::Vector3d& p) const;

 private:
  struct Index;
  const HandObservation* observation_ = nullptr;
  std::unique_ptr<Index> index_;
};

}  // namespace barehand
