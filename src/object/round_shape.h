#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "object/known_object.h"

namespace barehand {

/// A ball, or a cylinder with flat ends, of which a part was seen. Metres, in the frame of what was seen.
struct RoundShape {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< of a cylinder, unit length; zero for a ball
  double radius = 0;
  double half_length = 0;  ///< of a cylinder, as far as it was seen; 0 for a ball
  double deviation = 0;    ///< standard deviation of the surface opposite to what was seen

  /// Signed distance of a point from the surface, negative inside.
  double distance(const Eigen::Vector3d& p) const;
};

/// The ball or cylinder of which `surface` shows the outside, or the inside of a hollow one: its outer surface then
/// lies 3 mm farther out. None if the surface is not round, or only in part, or too small or large for a hand to close
/// around. What lies within the shape may be there as well, such as the inside of a mug beside its outside.
std::optional<RoundShape> fit_round_shape(std::span<const SurfaceSample> surface);

/// An object with that shape, without samples of its surface.
KnownObjectPtr make_round_object(const RoundShape& shape, std::int32_t id);

}  // namespace barehand
