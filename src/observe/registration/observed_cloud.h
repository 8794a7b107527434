#pragma once

#include <memory>
#include <vector>

#include "observe/observation.h"

namespace barehand {

/// The hand points of one frame with their normals, indexed for nearest-neighbour search. Refers to the observation:
/// nothing but reset() may be called after that has gone.
class ObservedCloud {
 public:
  ObservedCloud();
  explicit ObservedCloud(const HandObservation& observation);
  ~ObservedCloud();
  ObservedCloud(ObservedCloud&&) noexcept;
  ObservedCloud& operator=(ObservedCloud&&) noexcept;

  /// Another frame's points, in the same memory.
  void reset(const HandObservation& observation);

  std::size_t size() const;
  bool empty() const { return size() == 0; }
  /// Camera frame [m].
  Eigen::Vector3d point(std::size_t i) const;
  /// Unit, towards the camera; zero where undefined.
  Eigen::Vector3d normal(std::size_t i) const;
  Eigen::Vector3d centroid() const;
  /// Index of the point nearest to `p`. The cloud is not empty. Any index is a valid guess; a near one saves most of
  /// the search.
  std::size_t nearest(const Eigen::Vector3d& p, std::size_t guess) const;
  /// An object is seen in front of `p`: nothing can be said about a surface there.
  bool hidden(const Eigen::Vector3d& p) const;

 private:
  struct Index;
  const HandObservation* observation_ = nullptr;
  std::unique_ptr<Index> index_;
};

}  // namespace barehand
