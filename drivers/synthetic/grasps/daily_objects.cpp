#include "drivers/synthetic/grasps/daily_objects.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

#include "drivers/synthetic/grasps/solids.h"
#include "drivers/synthetic/rendering/shapes.h"

namespace barehand::synthetic {

// Objects of daily life, made of turned, boxed and lofted solids. Lengths in metres; a standing object's axis is z.

namespace {

using Eigen::Vector3d;

/// A frame with these axes x and y at a place.
SE3 frame(const Vector3d& x, const Vector3d& y, const Vector3d& t = Vector3d::Zero()) {
  SE3 T;
  T.R << x, y, x.cross(y);
  T.t = t;
  return T;
}

const Vector3d kX = Vector3d::UnitX(), kY = Vector3d::UnitY(), kZ = Vector3d::UnitZ();

/// A hold around the z axis, at the height z.
Hold around_z(double width, double length, double z = 0) {
  return {HoldKind::rod, frame(kZ, kX, z * kZ), width, length};
}
Hold ball_hold(double width) { return {HoldKind::ball, {}, width, width}; }
/// A hold between two faces across z; x is the direction towards the edge that the fingers come from.
Hold across_z(double width, double length, const Vector3d& place) {
  return {HoldKind::slab, frame(kX, kZ, place), width, length};
}

using Make = std::function<DailyObject()>;
struct Entry {
  std::string name;
  bool for_testing;
  Make make;
};

DailyObject turned(std::vector<Eigen::Vector2d> outline, const Material& material, std::vector<Hold> holds) {
  return {"", make_turned(outline), material, std::move(holds)};
}

Make rod(double diameter, double length, const Material& material) {
  return [=] {
    const double r = diameter / 2, h = length / 2;
    return turned({{0, -h}, {r, -h}, {r, h}, {0, h}}, material, {around_z(diameter, length)});
  };
}

Make pen(double diameter, double length, const Material& material) {
  return [=] {
    const double r = diameter / 2, h = length / 2;
    return turned({{0, -h}, {0.15 * r, -h}, {r, -h + 0.018}, {r, h}, {0, h}}, material,
                  {around_z(diameter, length, -h + 0.035)});
  };
}

/// A box that is held at `place` across its sides along z.
Make box(const Vector3d& sides, const Material& material, const Vector3d& place) {
  return [=] { return DailyObject{"", make_box(sides / 2), material, {across_z(sides.z(), sides.x(), place)}}; };
}

Make sphere(double diameter, const Material& material) {
  return [=] { return DailyObject{"", make_sphere(diameter / 2), material, {ball_hold(diameter)}}; };
}

DailyObject vessel(double radius, double height, double wall, const Material& material) {
  const double r = radius, h = height / 2;
  return turned({{0, -h}, {r, -h}, {r, h}, {r - wall, h}, {r - wall, -h + wall}, {0, -h + wall}}, material,
                {around_z(2 * radius, height)});
}

DailyObject glass() { return vessel(0.033, 0.12, 0.003, {{150, 170, 176}, 0.6}); }

DailyObject cup() {
  DailyObject cup = vessel(0.037, 0.09, 0.004, {{60, 92, 150}, 0.5});
  std::vector<Vector3d> path;
  for (int i = 0; i <= 24; ++i) {
    const double a = std::numbers::pi * (i / 24.0 - 0.5);
    path.emplace_back(0.035 + 0.026 * std::cos(a), 0, 0.028 * std::sin(a));
  }
  cup.mesh.append(make_closed_tube(path, 0.005));
  return cup;
}

DailyObject bottle() {
  return turned({{0, -0.11}, {0.033, -0.11}, {0.033, 0.03}, {0.014, 0.07}, {0.014, 0.11}, {0, 0.11}},
                {{52, 110, 72}, 0.7}, {around_z(0.066, 0.14, -0.04), around_z(0.028, 0.04, 0.095)});
}

DailyObject screwdriver() {
  return turned({{0, -0.16},
                 {0.003, -0.16},
                 {0.003, -0.04},
                 {0.008, -0.04},
                 {0.012, -0.025},
                 {0.012, 0.05},
                 {0.009, 0.06},
                 {0, 0.06}},
                {{190, 120, 30}, 0.2}, {around_z(0.024, 0.10, 0.01)});
}

DailyObject hammer() {
  DailyObject hammer = turned({{0, -0.11}, {0.014, -0.11}, {0.013, 0.15}, {0, 0.15}}, {{140, 96, 60}}, {});
  hammer.holds = {around_z(0.028, 0.25, -0.06)};
  TriangleMesh head = make_box({0.05, 0.014, 0.016});
  for (auto& v : head.vertices) v.z() += 0.15f;
  hammer.mesh.append(head);
  return hammer;
}

DailyObject knife() {
  DailyObject knife = turned({{0, -0.06}, {0.009, -0.057}, {0.0105, 0}, {0.0095, 0.06}, {0, 0.06}}, {{44, 44, 48}, 0.2},
                             {around_z(0.020, 0.12, 0)});
  TriangleMesh blade = make_box({0.012, 0.0009, 0.085});
  for (auto& v : blade.vertices) v.z() += 0.14f;
  knife.mesh.append(blade);
  return knife;
}

DailyObject spoon() {
  std::vector<Vector3d> path;
  for (int i = 0; i <= 12; ++i) path.emplace_back(0, 0, -0.075 + 0.14 * i / 12);
  DailyObject spoon{"", make_closed_tube(path, 0.0035), {{168, 172, 178}, 0.8}, {around_z(0.007, 0.14, -0.045)}};
  TriangleMesh bowl = make_sphere(1);
  for (std::size_t i = 0; i < bowl.vertices.size(); ++i) {
    auto& v = bowl.vertices[i];
    v = {0.019f * v.x(), 0.006f * v.y(), 0.028f * v.z() + 0.088f};
    auto& n = bowl.normals[i];
    n = Eigen::Vector3f(n.x() / 0.019f, n.y() / 0.006f, n.z() / 0.028f).normalized();
  }
  spoon.mesh.append(bowl);
  return spoon;
}

DailyObject apple() {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i <= 40; ++i) {
    const double a = std::numbers::pi * (i / 40.0 - 0.5), dent = 1 - 0.16 * std::pow(std::abs(std::sin(a)), 9);
    outline.emplace_back(i == 0 || i == 40 ? 0.0 : 0.036 * std::cos(a), 0.034 * dent * std::sin(a));
  }
  return {"", make_lathed(outline), {{178, 44, 36}, 0.4}, {ball_hold(0.071)}};
}

DailyObject key() {
  // A round head and a blade; the fingers hold the head across its thickness.
  DailyObject key = turned({{0, -0.00125}, {0.0125, -0.00125}, {0.0125, 0.00125}, {0, 0.00125}}, {{190, 180, 140}, 0.8},
                           {across_z(0.0025, 0.045, Vector3d::Zero())});
  TriangleMesh blade = make_box({0.018, 0.004, 0.00115});
  for (auto& v : blade.vertices) v.x() -= 0.028f;
  key.mesh.append(blade);
  return key;
}

Make disc(double diameter, double height, const Material& material) {
  return [=] {
    const double r = diameter / 2, h = height / 2;
    DailyObject disc = turned({{0, -h}, {r, -h}, {r, h}, {0, h}}, material, {});
    disc.holds = {across_z(height, diameter, {0.5 * r, 0, 0})};
    if (diameter > 0.03) disc.holds.push_back(around_z(diameter, height));
    return disc;
  };
}

DailyObject plate() {
  return {
      "",
      make_lathed({{0, -0.008},
                   {0.055, -0.008},
                   {0.095, 0.008},
                   {0.096, 0.011},
                   {0.094, 0.0125},
                   {0.055, -0.003},
                   {0, -0.003}}),
      {{220, 222, 226}, 0.5},
      {{HoldKind::slab, frame(Vector3d(40, 0, 16).normalized(), Vector3d(-16, 0, 40).normalized(), {0.077, 0, 0.0033}),
        0.0048, 0.19}}};
}

/// All objects. Every second one of a kind is for testing.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> kEntries = {
      // Vessels.
      {"cup", false, cup},
      {"glass", true, glass},
      {"can", false, rod(0.066, 0.115, {{180, 60, 60}, 0.7})},
      {"bottle", true, bottle},

      // Balls.
      {"ball", false, sphere(0.065, {{176, 190, 38}})},
      {"tennis_ball", true, sphere(0.067, {{196, 214, 60}})},
      {"apple", true, apple},
      {"ping_pong_ball", false, sphere(0.040, {{230, 226, 216}, 0.2})},
      {"golf_ball", true, sphere(0.0427, {{216, 220, 226}, 0.2})},
      {"marble", false, sphere(0.016, {{60, 110, 170}, 0.7})},
      {"hazelnut", true, sphere(0.014, {{150, 100, 60}})},
      {"orange_ball", false, sphere(0.055, {{220, 130, 30}})},

      // Rods and tools.
      {"pill_bottle", false, rod(0.034, 0.055, {{220, 140, 40}, 0.2})},
      {"rod_30", false, rod(0.030, 0.20, {{150, 120, 90}})},
      {"rod_40", true, rod(0.040, 0.18, {{120, 150, 90}})},
      {"rod_20", false, rod(0.020, 0.22, {{150, 150, 150}, 0.3})},
      {"screwdriver", true, screwdriver},
      {"hammer", false, hammer},
      {"knife", true, knife},

      // Pens and similar objects.
      {"pen", false, pen(0.010, 0.14, {{30, 40, 120}, 0.2})},
      {"pencil", true, pen(0.0078, 0.17, {{210, 170, 40}, 0.1})},
      {"spoon", true, spoon},
      {"chopstick", false, pen(0.007, 0.22, {{120, 80, 50}})},

      // Flat things.
      {"book", false, box({0.21, 0.14, 0.016}, {{60, 80, 60}}, {0.092, 0, 0})},
      {"carton", true, box({0.16, 0.10, 0.028}, {{196, 160, 110}}, {0.068, 0, 0})},
      {"phone", true, box({0.15, 0.072, 0.009}, {{40, 42, 46}, 0.5}, {0.064, 0, 0})},
      {"notebook", false, box({0.18, 0.12, 0.009}, {{80, 40, 90}}, {0.078, 0, 0})},
      {"plate", false, plate},
      {"card", false, box({0.085, 0.054, 0.001}, {{200, 200, 210}, 0.3}, {0.033, 0, 0})},
      {"key", true, key},

      // Discs and cubes.
      {"coin", false, disc(0.025, 0.002, {{180, 140, 80}, 0.7})},
      {"game_chip", true, disc(0.038, 0.0033, {{170, 40, 50}})},
      {"cube", false, box({0.025, 0.025, 0.025}, {{190, 60, 120}}, Vector3d::Zero())},
      {"die", true, box({0.018, 0.018, 0.018}, {{230, 230, 230}}, Vector3d::Zero())},
      {"jar_lid", false, disc(0.070, 0.016, {{190, 190, 60}, 0.5})},
      {"puck", true, disc(0.062, 0.022, {{36, 36, 40}})},
  };
  return kEntries;
}

}  // namespace

std::vector<std::string> object_names(bool for_testing) {
  std::vector<std::string> names;
  for (const Entry& entry : entries())
    if (entry.for_testing == for_testing) names.push_back(entry.name);
  return names;
}

bool is_object(const std::string& name) {
  return std::any_of(entries().begin(), entries().end(), [&](const Entry& entry) { return entry.name == name; });
}

DailyObject make_object(const std::string& name, double size) {
  const auto entry = std::find_if(entries().begin(), entries().end(), [&](const Entry& e) { return e.name == name; });
  assert(entry != entries().end());
  DailyObject object = entry->make();
  object.name = name;
  for (auto& v : object.mesh.vertices) v *= static_cast<float>(size);
  for (Hold& hold : object.holds) {
    hold.width *= size;
    hold.T_object_hold.t *= size;
  }
  return object;
}

}  // namespace barehand::synthetic
