#include "drivers/synthetic/people/body.h"

#include <utility>

#include "drivers/synthetic/rendering/body_shapes.h"

namespace barehand::synthetic {

// The body of a simulated person: its parts, and their poses at a given time.

namespace {

using Eigen::Vector3d;

constexpr Rgb kHair = {58, 44, 36};
const Vector3d kNeck(0, 0.02, 0.2);  // the point about which the head turns, in the body frame [m]

SmoothTrack make_track(const std::vector<BodyKey>& keys) {
  std::vector<double> times;
  std::vector<std::vector<double>> values;
  for (const BodyKey& key : keys) {
    times.push_back(key.time);
    std::vector<double>& list = values.emplace_back();
    for (const Vector3d& v : {key.shift, key.turn, key.head_turn, key.wrists[0], key.wrists[1]})
      list.insert(list.end(), v.data(), v.data() + 3);
  }
  return {std::move(times), std::move(values)};
}

/// Torso, legs and, if `neck`, the neck.
TriangleMesh make_torso(const BodySize& size, bool neck) {
  const double w = size.shoulder, d = size.depth, h = size.torso;
  std::vector<LoftRing> rings = {
      {{0, 0, -h - 0.85}, 1e-4, 1e-4},         {{0, 0, -h - 0.85}, 0.7 * w, 0.7 * d},  // both legs are one shape
      {{0, 0, -h - 0.05}, 0.92 * w, 0.95 * d}, {{0, 0, -0.9 * h}, 0.95 * w, d},
      {{0, 0, -0.6 * h}, 0.84 * w, 0.92 * d},  {{0, 0, -0.3 * h}, 0.94 * w, d},
      {{0, 0, -0.1 * h}, 0.98 * w, 0.9 * d},   {{0, 0, 0.0}, 0.92 * w, 0.7 * d},
      {{0, 0.01, 0.04}, 0.66 * w, 0.58 * d},   {{0, 0.02, 0.08}, 0.075, 0.065}};
  if (neck) rings.push_back({{0, 0.02, 0.22}, 0.052, 0.056});
  rings.push_back({rings.back().centre, 1e-4, 1e-4});
  return make_loft(rings);
}

/// The shoulder of an arm in the body frame, and the direction in which its elbow tends to be: down, outwards and a
/// little backwards.
Vector3d shoulder_of(const BodySize& size, int arm) { return {arm == 0 ? -size.shoulder : size.shoulder, 0, -0.03}; }
Vector3d towards_elbow(int arm) { return {arm == 0 ? -0.5 : 0.5, 0.3, -1}; }

}  // namespace

BodySize random_body(KeyedRandom& random) {
  BodySize size;
  size.shoulder = random.uniform(0.165, 0.215);
  size.depth = random.uniform(0.1, 0.15);
  size.torso = random.uniform(0.48, 0.58);
  size.head = random.uniform(0.92, 1.08);
  size.arm.upper = random.uniform(0.26, 0.32);
  size.arm.forearm = random.uniform(0.23, 0.28);
  size.arm.shoulder_radius = random.uniform(0.052, 0.072);
  size.arm.cuff_radius = random.uniform(0.03, 0.045);
  return size;
}

std::array<SceneObject, kHeadParts> make_head(double size) {
  const auto part = [&](const char* name, const Vector3d& centre, const Vector3d& half_axes, const Rgb& colour) {
    SceneObject object{name, make_ellipsoid(size * half_axes), {colour}};
    for (auto& v : object.mesh.vertices) v += (size * centre).cast<float>();
    return object;
  };
  return {part("skull", {0, 0, 0.02}, {0.075, 0.094, 0.105}, kSkinColour),
          part("jaw", {0, -0.03, -0.055}, {0.055, 0.06, 0.06}, kSkinColour),
          part("nose", {0, -0.098, -0.012}, {0.015, 0.02, 0.026}, kSkinColour),
          part("right ear", {-0.076, 0.01, 0}, {0.01, 0.02, 0.032}, kSkinColour),
          part("left ear", {0.076, 0.01, 0}, {0.01, 0.02, 0.032}, kSkinColour),
          part("hair", {0, 0.02, 0.045}, {0.082, 0.094, 0.098}, kHair)};
}

Body::Body(Setting setting) : setting_(std::move(setting)), track_(make_track(setting_.keys)) {}

std::vector<SceneObject> Body::objects() const {
  const ArmSize& arm = setting_.size.arm;
  std::vector<SceneObject> list = {{"torso", make_torso(setting_.size, setting_.head), {kClothColour}}};
  for (const char* name : {"right upper arm", "left upper arm"})
    list.push_back({name, make_limb(arm.upper, arm.shoulder_radius, arm.elbow_radius), {kClothColour}});

  // Add the forearms and the head, in the order of poses().
  const SceneObject forearm{"forearm", make_limb(arm.forearm, arm.elbow_radius, arm.cuff_radius), {kClothColour}};
  list.insert(list.end(), setting_.right_forearm ? 2 : 1, forearm);
  if (!setting_.head) return list;
  for (SceneObject& part : make_head(setting_.size.head)) list.push_back(std::move(part));
  return list;
}

BodyKey Body::at(double time) const {
  const std::vector<double> v = track_.at(time);
  auto next = [p = v.data()]() mutable { return Vector3d(Eigen::Map<const Vector3d>(std::exchange(p, p + 3))); };
  BodyKey key;
  key.time = time;
  key.shift = next();
  key.turn = next();
  key.head_turn = next();
  for (Vector3d& wrist : key.wrists) wrist = next();
  return key;
}

SE3 Body::frame(const BodyKey& key) const { return setting_.T_world_body * SE3{exp_so3(key.turn), key.shift}; }

Vector3d Body::right_elbow(double time, const Vector3d& right_wrist) const {
  const SE3 T_world_body = frame(at(time));
  const BodySize& size = setting_.size;
  return T_world_body *
         elbow_between(size.arm, shoulder_of(size, 0), T_world_body.inverse() * right_wrist, towards_elbow(0));
}

std::vector<SE3> Body::poses(double time, const std::optional<Vector3d>& right_wrist) const {
  // Pose the torso, and point both arms towards their wrists.
  BodyKey key = at(time);
  const SE3 T_world_body = frame(key);
  if (right_wrist) key.wrists[0] = T_world_body.inverse() * *right_wrist;
  std::vector<SE3> list = {T_world_body}, forearms;

  // Let the elbow lie between the shoulder and the wrist.
  for (int arm = 0; arm < 2; ++arm) {
    const Vector3d shoulder = shoulder_of(setting_.size, arm);
    const Vector3d elbow = elbow_between(setting_.size.arm, shoulder, key.wrists[arm], towards_elbow(arm));
    list.push_back(T_world_body * limb_between(shoulder, elbow));
    if (arm == 1 || setting_.right_forearm) forearms.push_back(T_world_body * limb_between(elbow, key.wrists[arm]));
  }

  // The forearms come after the upper arms.
  list.insert(list.end(), forearms.begin(), forearms.end());
  if (!setting_.head) return list;

  // Turn the head on the neck.
  const Vector3d centre = setting_.size.head * Vector3d(0, -0.02, 0.09);
  const SE3 T_world_head = T_world_body * SE3{exp_so3(key.head_turn), kNeck} * SE3{Eigen::Matrix3d::Identity(), centre};
  list.insert(list.end(), kHeadParts, T_world_head);
  return list;
}

}  // namespace barehand::synthetic
