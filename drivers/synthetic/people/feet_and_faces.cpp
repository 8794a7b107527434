// Scenes without a hand that show other parts of people near the camera.
#include <algorithm>

#include "drivers/synthetic/people/desk.h"
#include "drivers/synthetic/people/hand_wandering.h"
#include "drivers/synthetic/people/handless_motion.h"
#include "drivers/synthetic/people/people_sequences.h"
#include "drivers/synthetic/random_keys.h"
#include "drivers/synthetic/rendering/body_shapes.h"
#include "drivers/synthetic/rendering/stage_set.h"
#include "math/angles.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

/// A foot. Its frame: the ankle at the origin, the toes towards -y, z up.
struct Foot {
  double length = 0.26;
  bool bare = true;
};

/// The foot without its toes: a loft along its length. The loft's z axis points towards the toes.
TriangleMesh make_sole(const Foot& foot) {
  const double l = foot.length, wide = foot.bare ? 1 : 1.12;
  const LoftRing rings[] = {{{0, 0.012, -0.05}, 1e-3, 1e-3},
                            {{0, 0.012, -0.045}, 0.022 * wide, 0.025},
                            {{0, 0.005, -0.02}, 0.032 * wide, 0.036},
                            {{0, 0.0, 0.03}, 0.034 * wide, 0.044},
                            {{0, 0.014, 0.3 * l}, 0.037 * wide, 0.032},
                            {{0, 0.022, 0.5 * l}, 0.043 * wide, 0.022},
                            {{0, 0.028, 0.66 * l}, 0.046 * wide, foot.bare ? 0.014 : 0.024},
                            {{0, 0.03, (foot.bare ? 0.7 : 0.8) * l}, 0.03 * wide, 0.008},
                            {{0, 0.03, (foot.bare ? 0.71 : 0.82) * l}, 1e-3, 1e-3}};
  return make_loft(rings);
}

/// Adds a foot, its toes if it is bare, and its leg, which leans back by `leg_lean` [rad].
void add_foot(std::vector<PlacedObject>& objects, const Foot& foot, const SE3& T_world_foot, bool left,
              double leg_lean) {
  // Add the sole; the loft's z axis becomes -y of the foot, and its y axis -z.
  Eigen::Matrix3d R_lying;
  R_lying << -1, 0, 0, 0, 0, -1, 0, -1, 0;
  const Rgb colour = foot.bare ? kSkinColour : Rgb{48, 44, 44};
  objects.push_back({{"foot", make_sole(foot), {colour}}, T_world_foot * SE3{R_lying, Vector3d::Zero()}});

  // Add the toes, from the large one on the inner side to the small one on the outer side.
  const double inside = left ? -1 : 1;
  for (int i = 0; foot.bare && i < 5; ++i) {
    const double radius = i == 0 ? 0.0125 : 0.0085 - 0.0006 * i,
                 reach = foot.length * (0.79 - 0.028 * i * (1 + 0.25 * i));
    const double x = inside * (0.034 - (i == 0 ? 0 : 0.005) - 0.0155 * i);
    const Vector3d root(x, -0.6 * foot.length, -0.027), tip(1.1 * x, -reach, -0.03);
    objects.push_back(
        {{"toe", make_limb((tip - root).norm(), radius, radius), {colour}}, T_world_foot * limb_between(root, tip)});
  }

  // Add the leg.
  const Vector3d knee(0, 0.42 * std::sin(leg_lean), 0.42 * std::cos(leg_lean));
  objects.push_back({{"leg", make_limb(0.42, 0.038, 0.058), {foot.bare ? kSkinColour : kClothColour}},
                     T_world_foot * limb_between(Vector3d::Zero(), knee)});
}

}  // namespace

std::unique_ptr<Sequence> make_feet(std::uint64_t seed) {
  // Let the camera see the feet from above, as people see their own, or from the front.
  KeyedRandom random = scene_random(seed);
  StagedSequence::Setting s = handless_setting(seed, random);
  s.T_camera_world = camera_above_table(random.uniform(15, 80) * kDegree, random.uniform(0.5, 1.05));
  s.objects.push_back(make_floor(0));
  s.objects.push_back(make_wall(random.uniform(0.8, 2)));

  // Let both feet stand, or lie with the soles towards the camera.
  Foot foot{random.uniform(0.23, 0.29), random.uniform() < 0.6};
  const double heading = random.uniform() < 0.5 ? random.uniform(-0.6, 0.6) : random.uniform(-3.1, 3.1);
  const bool lying = random.uniform() < 0.3;
  for (const bool left : {false, true}) {
    // Place each foot, turned a little from the common heading.
    const double apart = (left ? 0.5 : -0.5) * random.uniform(0.13, 0.3);
    const Eigen::Matrix3d R = exp_so3({0, 0, heading + random.uniform(-0.3, 0.3)}) *
                              exp_so3({lying ? random.uniform(-1.4, -1.0) : 0.0, 0, 0});
    const Vector3d place = exp_so3({0, 0, heading}) * Vector3d(apart, random.uniform(0, 0.1), lying ? 0.06 : 0.04);
    add_foot(s.objects, foot, {R, place}, left, lying ? random.uniform(-0.1, 0.3) : random.uniform(-0.3, 0.3));
  }
  return std::make_unique<StagedSequence>(std::move(s));
}

std::unique_ptr<Sequence> make_faces(std::uint64_t seed) {
  // The camera is 0.5 to 1 m away from the heads.
  KeyedRandom random = scene_random(seed);
  StagedSequence::Setting s = handless_setting(seed, random);
  const double distance = random.uniform(0.55, 0.8);
  s.T_camera_world = camera_above_table(random.uniform(-15, 25) * kDegree, distance);
  s.objects.push_back(make_wall(random.uniform(0.6, 2)));

  // The bodies stand side by side with hanging arms.
  const int count = 1 + static_cast<int>(random.uniform(0, 3));
  for (int i = 0; i < count; ++i) {
    Body::Setting body{random_body(random), {}, {}, true, true};
    const double x = 0.3 * (i - 0.5 * (count - 1)), y = random.uniform(-0.05, 0.2);
    body.T_world_body = {exp_so3({0, 0, random.uniform(-0.5, 0.5)}), {x, y, random.uniform(-0.4, -0.2)}};

    // Move each body a little from key to key, with hanging arms.
    const double hang = -body.size.arm.reach();
    for (double time = 0; time <= s.duration; time += kHandlessStep)
      body.keys.push_back({time,
                           random_within({0.05, 0.05, 0.03}, random),
                           random_within({0.15, 0.15, 0.4}, random),
                           random_within({0.5, 0.3, 0.9}, random),
                           {Vector3d(-0.26, 0, hang), Vector3d(0.26, 0, hang)}});
    s.bodies.emplace_back(std::move(body));
  }
  return std::make_unique<StagedSequence>(std::move(s));
}

}  // namespace barehand::synthetic
