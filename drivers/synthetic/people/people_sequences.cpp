#include "drivers/synthetic/people/people_sequences.h"

#include <cmath>
#include <numbers>

#include "drivers/synthetic/people/desk.h"
#include "drivers/synthetic/people/hand_wandering.h"
#include "drivers/synthetic/people/handless_motion.h"
#include "drivers/synthetic/random_keys.h"
#include "drivers/synthetic/rendering/stage_set.h"
#include "math/angles.h"

namespace barehand::synthetic {

// Simulated scenes of a person or a desk, built from a seed: with a moving hand (a person who faces the camera, desk
// work) and without any hand (a person who hides the hands, an empty desk).

namespace {

using Eigen::Vector3d;

constexpr double kDuration = 6;   // duration of a scene with a hand [s]
constexpr double kFloor = -0.72;  // height of the floor relative to the desk's top [m]

StagedSequence::Setting setting(std::uint64_t seed) {
  StagedSequence::Setting s;
  s.duration = kDuration;
  s.seed = seed;
  return s;
}

/// T_world_body of a body whose right shoulder is at this position; with `heading` 0, it faces -y.
SE3 standing(const BodySize& size, const Vector3d& right_shoulder, double heading) {
  const Eigen::Matrix3d R = exp_so3({0, 0, heading});
  return {R, right_shoulder + R * Vector3d(size.shoulder, 0, 0)};
}

/// Position of a left wrist, in the body frame, that the camera does not see well: behind the back, or hanging down
/// next to the body.
Vector3d wrist_at_rest(const BodySize& size, KeyedRandom& random) {
  if (random.uniform() < 0.5) return {0.05, size.depth + 0.06, -0.8 * size.torso};
  return {size.shoulder + 0.06, random.uniform(-0.05, 0.05), -size.arm.reach()};
}

/// How a scene shows its hand. World frame.
struct HandSetting {
  Vector3d fingers, palm;  ///< directions in which the fingers tend to point, and which the palm faces
  double roll = 0.5;       ///< largest rotation of the palm about the fingers [rad]
  Vector3d range;          ///< half sides of the box in which the hand's middle moves [m]
};

/// Adds a hand that moves about `centre`, and the body that it belongs to.
void add_person(StagedSequence::Setting& s, const BodySize& size, const SE3& T_world_body, const Vector3d& centre,
                const HandSetting& hand, bool head, KeyedRandom& random) {
  // Add the body, which sways a little.
  Body::Setting body{size, T_world_body, {}, head, false};
  const Vector3d left_wrist = wrist_at_rest(size, random);
  for (double time = 0; time <= kDuration; time += 2)
    body.keys.push_back({time,
                         random_within({0.02, 0.02, 0.005}, random),
                         random_within({0.05, 0.05, 0.1}, random),
                         random_within({0.2, 0.1, 0.5}, random),
                         {left_wrist, left_wrist}});
  s.bodies.emplace_back(std::move(body));

  // Let the fingers point in a direction between that of the forearm and the one in which they tend to point.
  const Vector3d forearm = (centre - s.bodies.front().right_elbow(0, centre)).normalized();
  const double roll = random.uniform(-hand.roll, hand.roll);
  const Eigen::Matrix3d palm = palm_facing(forearm + 0.8 * hand.fingers, hand.palm);
  s.R_world_hand = palm * exp_so3({0, 0, roll});
  s.hand = wander({.duration = kDuration, .centre = centre, .range = hand.range, .base = s.R_world_hand}, random);
}

}  // namespace

std::unique_ptr<Sequence> make_person(std::uint64_t seed) {
  // Place the camera, which faces the hand, and a wall.
  KeyedRandom random = scene_random(seed);
  StagedSequence::Setting s = setting(seed);
  const double distance = random.uniform(0.5, 0.85), range = 0.11 * distance;
  s.T_camera_world = camera_above_table(random.uniform(-10, 25) * kDegree, distance);
  s.objects.push_back(make_wall(random.uniform(1.0, 2.5)));

  // Place the body behind the hand, at the distance of a bent arm.
  const BodySize size = random_body(random);
  const Vector3d centre = random_within({0.12 * distance, 0, 0.05 * distance}, random);
  const Vector3d to_shoulder(random.uniform(-0.4, 0.4), random.uniform(0.6, 1), random.uniform(-0.1, 0.6));
  const Vector3d shoulder = centre + random.uniform(0.6, 0.9) * size.arm.reach() * to_shoulder.normalized();
  const SE3 T_world_body = standing(size, shoulder, random.uniform(-0.4, 0.4));

  // Add the hand: four of five hands show the palm, the others the back.
  const Vector3d palm = random.uniform() < 0.8 ? Vector3d(0, -1, 0) : Vector3d(0, 1, 0);
  add_person(s, size, T_world_body, centre, {Vector3d::UnitZ(), palm, 0.5, {range, range, 0.6 * range}}, true, random);
  return std::make_unique<StagedSequence>(std::move(s));
}

std::unique_ptr<Sequence> make_desk_work(std::uint64_t seed) {
  KeyedRandom random = scene_random(seed);
  StagedSequence::Setting s = setting(seed);
  s.T_camera_world = camera_above_table(random.uniform(30, 65) * kDegree, random.uniform(0.65, 0.85), 0.1);

  // Place the body on the far side of the desk.
  const BodySize size = random_body(random);
  const Vector3d centre(random.uniform(-0.08, 0.08), random.uniform(-0.05, 0.05), random.uniform(0.1, 0.16));
  const Vector3d shoulder =
      centre + Vector3d(random.uniform(-0.15, 0.1), random.uniform(0.32, 0.4), random.uniform(0.2, 0.28));
  const SE3 T_world_body = standing(size, shoulder, random.uniform(-0.3, 0.3));

  // Place the desk between the body and the camera.
  s.objects =
      make_desk(-0.45, T_world_body.t.y() - size.depth - 0.04,
                FreeLines{centre.head<2>(), shoulder.head<2>(), s.T_camera_world.inverse().t.head<2>()}, random);
  s.objects.push_back(make_floor(kFloor));
  s.objects.push_back(make_wall(random.uniform(1.2, 2.5)));
  add_person(s, size, T_world_body, centre, {-Vector3d::UnitY(), -Vector3d::UnitZ(), 0.9, {0.09, 0.07, 0.03}}, true,
             random);
  return std::make_unique<StagedSequence>(std::move(s));
}

std::unique_ptr<Sequence> make_egocentric(std::uint64_t seed) {
  KeyedRandom random = scene_random(seed);
  StagedSequence::Setting s = setting(seed);
  s.T_camera_world = camera_above_table(random.uniform(35, 60) * kDegree, random.uniform(0.55, 0.7), 0.06);
  const Vector3d eyes = s.T_camera_world.inverse().t;

  // Place the body below the eyes, leaning forward until the hand is within reach.
  const BodySize size = random_body(random);
  const Vector3d centre(random.uniform(-0.06, 0.1), random.uniform(-0.04, 0.06), random.uniform(0.09, 0.15));
  Vector3d shoulder = eyes + Vector3d(size.shoulder, -0.03, -random.uniform(0.22, 0.28));
  const Vector3d beyond = centre - shoulder;
  shoulder += std::max(0.0, beyond.norm() - 0.92 * size.arm.reach()) * beyond.normalized();
  const SE3 T_world_body = standing(size, shoulder, std::numbers::pi);

  // Place the desk in front of the body.
  s.objects =
      make_desk(T_world_body.t.y() + size.depth + 0.04, 0.55,
                FreeLines{centre.head<2>(), shoulder.head<2>(), s.T_camera_world.inverse().t.head<2>()}, random);
  s.objects.push_back(make_floor(kFloor));
  s.objects.push_back(make_wall(random.uniform(1.0, 2.0)));
  add_person(s, size, T_world_body, centre, {Vector3d::UnitY(), -Vector3d::UnitZ(), 0.9, {0.09, 0.07, 0.03}}, false,
             random);
  return std::make_unique<StagedSequence>(std::move(s));
}

std::unique_ptr<Sequence> make_empty_person(std::uint64_t seed) {
  // Choose the view of the camera and the distance of the wall.
  KeyedRandom random = scene_random(seed);
  StagedSequence::Setting s = handless_setting(seed, random);
  s.T_camera_world = camera_above_table(random.uniform(-10, 25) * kDegree, random.uniform(0.6, 1.1));
  s.objects.push_back(make_wall(random.uniform(1.0, 2.5)));

  // Let each arm either be visible and end in a sleeve, or rest out of sight.
  Body::Setting body{random_body(random), {}, {}, true, true};
  const bool shown[] = {random.uniform() < 0.6, random.uniform() < 0.6};
  const Vector3d rest = wrist_at_rest(body.size, random);

  // Move the body a little from key to key.
  for (double time = 0; time <= s.duration; time += kHandlessStep) {
    BodyKey key{time,
                random_within({0.05, 0.05, 0.02}, random),
                random_within({0.1, 0.1, 0.4}, random),
                random_within({0.4, 0.2, 0.8}, random),
                {}};

    // Choose the places of both wrists.
    for (int arm = 0; arm < 2; ++arm) {
      const double outside = arm == 0 ? -1 : 1;
      const Vector3d sleeve = Vector3d(outside * 0.15, -0.36, -0.1) + random_within({0.15, 0.1, 0.2}, random);
      key.wrists[arm] = shown[arm] ? sleeve : Vector3d(outside * rest.x(), rest.y(), rest.z());
    }
    body.keys.push_back(key);
  }

  // Place the body in front of the camera, turned a little.
  body.T_world_body = {exp_so3({0, 0, random.uniform(-0.5, 0.5)}),
                       {random.uniform(-0.1, 0.1), random.uniform(0.2, 0.5), random.uniform(0, 0.2)}};
  s.bodies.emplace_back(std::move(body));
  return std::make_unique<StagedSequence>(std::move(s));
}

std::unique_ptr<Sequence> make_empty_desk(std::uint64_t seed) {
  KeyedRandom random = scene_random(seed);
  StagedSequence::Setting s = handless_setting(seed, random);
  s.T_camera_world = camera_above_table(random.uniform(30, 65) * kDegree, random.uniform(0.55, 0.9));
  s.objects = make_desk(-0.45, random.uniform(0.3, 0.6), {}, random);
  s.objects.push_back(make_floor(kFloor));
  s.objects.push_back(make_wall(random.uniform(1.0, 2.5)));
  return std::make_unique<StagedSequence>(std::move(s));
}

}  // namespace barehand::synthetic
