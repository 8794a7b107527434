// The desk with its objects, the wall and the floor of simulated scenes.
#include "drivers/synthetic/people/desk.h"

#include <algorithm>

#include "drivers/synthetic/people/hand_wandering.h"
#include "drivers/synthetic/rendering/shapes.h"
#include "math/share_along.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

constexpr double kThickness = 0.03;  // thickness of the desk's top [m]
constexpr double kApart = 0.17;      // minimum distance between the centre of a tall object and the FreeLines [m]
constexpr int kTallObjects = 6;      // number of tall objects to try; those too close to the FreeLines are left out

SE3 standing_at(const Vector3d& place, double heading) { return {exp_so3({0, 0, heading}), place}; }

/// A flat box, such as a keyboard.
SceneObject make_slab(const char* name, const Vector3d& half_sides, const Rgb& colour) {
  return {name, make_box(half_sides), {colour}};
}

/// A random mug, box or cylinder with its centre at the origin, and its height [m].
std::pair<SceneObject, double> make_tall_object(KeyedRandom& random) {
  const double kind = random.uniform();
  const auto shade = static_cast<std::uint8_t>(random.uniform(40, 220));

  // Three in ten objects are mugs.
  if (kind < 0.3) {
    const MugSize size{random.uniform(0.034, 0.045), random.uniform(0.08, 0.12), 0.004};
    return {{"mug", make_mug(size), {{182, 48, 40}, 0.6}}, size.height};
  }

  // Half of the other objects are boxes, and half are cylinders.
  if (kind < 0.65) {
    const Vector3d half(random.uniform(0.02, 0.12), random.uniform(0.02, 0.1), random.uniform(0.015, 0.12));
    return {{"box", make_box(half), {{shade, 120, 90}}}, 2 * half.z()};
  }
  const double radius = random.uniform(0.02, 0.06), half = random.uniform(0.03, 0.12);
  const Eigen::Vector2d outline[] = {{1e-4, -half}, {radius, -half}, {radius, half}, {1e-4, half}};
  return {{"cylinder", make_turned(outline), {{90, shade, 140}}}, 2 * half};
}

bool is_free(const FreeLines& lines, const Eigen::Vector2d& place) {
  return std::min(segment_distance(lines.hand, lines.shoulder, place),
                  segment_distance(lines.hand, lines.camera, place)) > kApart;
}

}  // namespace

std::vector<PlacedObject> make_desk(double near_y, double far_y, const std::optional<FreeLines>& free,
                                    KeyedRandom& random) {
  // Place the desk, and flat objects above which a hand may work.
  const double half_depth = 0.5 * (far_y - near_y), middle = 0.5 * (near_y + far_y);
  std::vector<PlacedObject> list;
  list.push_back({make_slab("desk", {random.uniform(0.6, 0.9), half_depth, 0.5 * kThickness}, {148, 120, 92}),
                  standing_at({random.uniform(-0.2, 0.2), middle, -0.5 * kThickness}, 0)});

  const double key_height = random.uniform(0.006, 0.012), page_height = random.uniform(0.005, 0.02);
  list.push_back(
      {make_slab("keyboard", {0.215, 0.07, key_height}, {52, 52, 58}),
       standing_at({random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), key_height}, random.uniform(-0.2, 0.2))});
  list.push_back({make_slab("book", {0.075, 0.11, page_height}, {170, 40, 60}),
                  standing_at({random.uniform(-0.35, 0.35), middle, page_height}, random.uniform(-1.5, 1.5))});

  // Place tall objects, which must neither touch the arm nor hide the hand.
  for (int i = 0; i < kTallObjects; ++i) {
    auto [object, height] = make_tall_object(random);
    const Eigen::Vector2d place(random.uniform(-0.45, 0.45), random.uniform(near_y + 0.05, far_y - 0.05));
    const double heading = random.uniform(-3, 3);
    if (!free || is_free(*free, place))
      list.push_back({std::move(object), standing_at({place.x(), place.y(), 0.5 * height}, heading)});
  }
  return list;
}

PlacedObject make_wall(double y) {
  return {{"wall", make_plate({-4, 0, -3}, {8, 0, 0}, {0, 0, 6}), {{168, 164, 158}}},
          {Eigen::Matrix3d::Identity(), {0, y, 0}}};
}

PlacedObject make_floor(double z) {
  return {{"floor", make_plate({-4, -2, 0}, {8, 0, 0}, {0, 7, 0}), {{116, 104, 96}}},
          {Eigen::Matrix3d::Identity(), {0, 0, z}}};
}

}  // namespace barehand::synthetic
