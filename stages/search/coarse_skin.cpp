// Thins a hand's skin for the search, and adds a piece of forearm.
#include "stages/search/coarse_skin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/random.h"

namespace barehand {

namespace {

constexpr double kForearmLength = 0.035;  // length of the forearm stub [m]; short, because the wrist may be bent

void add(CoarseSkin::Part& part, const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
  part.x.push_back(static_cast<float>(p.x())), part.y.push_back(static_cast<float>(p.y()));
  part.z.push_back(static_cast<float>(p.z())), part.nx.push_back(static_cast<float>(n.x()));
  part.ny.push_back(static_cast<float>(n.y())), part.nz.push_back(static_cast<float>(n.z()));
}

/// Thins the skin to about one point per `spacing` x `spacing` [m] by stratified random sampling. A fixed stride would
/// give moiré patterns with the spiral in which the surface points are ordered.
CoarseSkin::Part thinned(const SegmentSurface& skin, int segment, double spacing) {
  double area = 0;
  for (const float a : skin.area) area += a;
  const auto count = std::min(skin.size(), static_cast<std::size_t>(std::ceil(area / (spacing * spacing))));

  // Describe the part, whose points share its area equally.
  CoarseSkin::Part part;
  part.segment = segment;
  part.width = count > 0 ? static_cast<float>(std::sqrt(area / static_cast<double>(count))) : 0.0f;

  // Draw one point from each stratum.
  KeyedRandom random(0, static_cast<std::uint32_t>(segment));
  const double stratum = static_cast<double>(skin.size()) / static_cast<double>(std::max<std::size_t>(1, count));
  for (std::size_t k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>((static_cast<double>(k) + random.uniform()) * stratum);
    const std::size_t j = std::min(skin.size() - 1, i);
    add(part, {skin.x[j], skin.y[j], skin.z[j]}, {skin.nx[j], skin.ny[j], skin.nz[j]});
  }
  return part;
}

/// Points on an elliptic cylinder that continues the palm beyond its proximal end.
CoarseSkin::Part forearm_stub(const SegmentProfile& palm, double spacing) {
  // Derive the number of points from the spacing.
  const double a = palm.half_width[0], b = palm.half_thickness[0];
  const int around = std::max(6, static_cast<int>(std::lround(std::numbers::pi * (a + b) / spacing)));
  const int along = std::max(2, static_cast<int>(std::lround(kForearmLength / spacing)));
  CoarseSkin::Part part;
  part.segment = kPalm;
  part.width = static_cast<float>(spacing);

  // Place the points; every second ring is turned by half a spacing.
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5 * (i % 2)) / around;
      const Eigen::Vector3d p(a * std::cos(angle) + palm.flesh_offset_x[0],
                              b * std::sin(angle) + palm.flesh_offset_y[0], (i + 0.5) * kForearmLength / along);
      add(part, p, Eigen::Vector3d(b * std::cos(angle), a * std::sin(angle), 0).normalized());
    }
  }
  return part;
}

}  // namespace

CoarseSkin make_coarse_skin(const HandProfile& profile, const HandSurface& surface, double spacing) {
  CoarseSkin coarse;
  for (int s = 0; s < kSegmentCount; ++s) coarse.parts.push_back(thinned(surface[s], s, spacing));
  coarse.forearm = forearm_stub(profile.segments[kPalm], spacing);
  return coarse;
}

}  // namespace barehand
