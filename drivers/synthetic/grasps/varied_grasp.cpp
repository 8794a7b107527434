#include "drivers/synthetic/grasps/varied_grasp.h"

#include <algorithm>
#include <numbers>

#include "core/quote.h"
#include "drivers/synthetic/grasps/grasp_plan.h"
#include "drivers/synthetic/random_keys.h"
#include "drivers/synthetic/rendering/shapes.h"
#include "drivers/synthetic/sequences/keyframes.h"
#include "hand/grasps/grasp_types.h"
#include "math/angles.h"

namespace barehand::synthetic {

// Sequences of any grasp of any object, drawn by the seed.

namespace {

using Eigen::Vector3d;

/// Streams of random numbers; the plan of the grasp has another one.
enum class Stream : std::uint32_t { shape = 2, choice = 3, scene = 4 };
KeyedRandom random_for(Stream stream, std::uint64_t seed) {
  return {seed, static_cast<std::uint32_t>(stream), 0, static_cast<std::uint32_t>(Draw::variation)};
}

/// A class of grasps and an object.
struct Choice {
  int type = 0;
  std::string object;
};

Result<Choice> drawn(const GraspChoice& wanted, std::uint64_t seed) {
  // Check the names.
  const auto& types = grasp_types();
  const auto type = grasp_type_from_name(wanted.type);
  if (!wanted.type.empty() && !type) {
    std::vector<std::string_view> names;
    for (const GraspType& known : types) names.push_back(known.name);
    return fail("grasp=" + wanted.type + " is no class of grasps", "sim:grasp", "choose one of: " + comma_list(names));
  }

  // Check the object in the same way.
  if (!wanted.object.empty() && !is_object(wanted.object))
    return fail("there is no object \"" + wanted.object + "\"", "sim:grasp",
                "choose one of: " + comma_list(object_names(false)) + ", " + comma_list(object_names(true)));

  // Draw the class among those that the object fits, then the object.
  KeyedRandom random = random_for(Stream::choice, seed);
  const bool testing = seed >= kFirstTestSeed;
  std::vector<int> possible;
  for (int i = 0; i < static_cast<int>(types.size()); ++i)
    if (wanted.object.empty() || can_hold(i, wanted.object)) possible.push_back(i);
  Choice choice{type ? *type : possible[random.bits() % possible.size()], wanted.object};

  // Draw an object of this class, if none was given.
  if (choice.object.empty()) {
    const std::vector<std::string> objects = objects_for(choice.type, testing);
    choice.object = objects[random.bits() % objects.size()];
  }
  return choice;
}

/// T_camera_palm of a hand in the middle of the picture, seen from somewhere around its fingers' axis.
SE3 drawn_view(KeyedRandom& random) {
  // The direction from the hand to the camera, in the palm frame.
  const double around = random.uniform(0, 2 * std::numbers::pi), rise = random.uniform(-0.6, 0.5);
  const Vector3d to_camera(std::cos(rise) * std::cos(around), std::cos(rise) * std::sin(around), -std::sin(rise));

  // The fingers point up in the picture, more or less.
  const Vector3d z = -to_camera, fingers = -Vector3d::UnitZ();
  const Vector3d y = -(fingers - fingers.dot(z) * z).normalized();

  // Turn the camera about its optical axis at random.
  SE3 T;
  T.R.row(0) = y.cross(z).transpose();
  T.R.row(1) = y.transpose();
  T.R.row(2) = z.transpose();
  T.R = exp_so3(random.uniform(-0.9, 0.9) * Vector3d::UnitZ()) * T.R;

  // Place the hand near the middle of the image.
  const Vector3d centre(0, -0.02, -0.10);
  const Vector3d place(random.uniform(-0.04, 0.04), random.uniform(-0.03, 0.03), random.uniform(0.45, 0.75));
  T.t = place - T.R * centre;
  return T;
}

/// A wall behind the hand.
SceneObject make_wall(double distance, KeyedRandom& random) {
  const Eigen::Matrix3d R = exp_so3({random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0});
  const Vector3d middle(0, 0, distance), right = R * Vector3d::UnitX(), down = R * Vector3d::UnitY();
  const auto grey = static_cast<std::uint8_t>(90 + 100 * random.uniform());
  return {"wall", make_plate(middle - 2 * right - 2 * down, 4 * down, 4 * right), {{grey, grey, grey}}, false};
}

class VariedGrasp : public Sequence {
 public:
  VariedGrasp(PlannedGrasp plan, std::string_view type, std::uint64_t seed)
      : type_(type), T_palm_object_(plan.T_palm_object) {
    KeyedRandom random = random_for(Stream::scene, seed);
    T_camera_grasp_ = drawn_view(random);
    track_ = std::make_unique<HandTrack>(T_camera_grasp_.R, keys(plan, random));
    objects_.push_back({plan.object.name, std::move(plan.object.mesh), plan.object.material, true});
    objects_.push_back(make_wall(T_camera_grasp_.t.z() + random.uniform(0.35, 0.9), random));
  }

  double duration() const override { return 5.3; }
  const std::vector<SceneObject>& objects() const override { return objects_; }
  std::string_view grasp_type() const override { return type_; }

  SceneState at(double time) const override {
    // The object moves with the palm while it is held.
    SceneState state;
    HandState hand{track_->at(time)};
    const SE3& T_camera_palm = hand.skeleton.T_camera_palm;
    state.held = time > kGrasped && time < kReleasing;
    state.T_camera_object = {(state.held ? T_camera_palm : T_camera_grasp_) * T_palm_object_, SE3{}};

    // The elbow moves 0.8 times as far as the wrist.
    hand.elbow = T_camera_grasp_ * Vector3d(0, 0.03, 0.38) + 0.8 * (T_camera_palm.t - T_camera_grasp_.t);
    state.hands = {hand};
    return state;
  }

 private:
  // The object is held between these times [s].
  static constexpr double kGrasped = 1.9, kReleasing = 4.2;

  std::vector<HandKey> keys(const PlannedGrasp& plan, KeyedRandom& random) const {
    // Places and turns on the way, relative to the grasp.
    const auto draw = [&](double size) {
      return Vector3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
    };
    const Vector3d grasp = T_camera_grasp_.t, out = T_camera_grasp_.R * plan.withdrawal;
    const Vector3d before = grasp + 0.06 * out, start = grasp + 0.11 * out + draw(0.02);
    const Vector3d lifted = grasp + draw(0.04), carried = grasp + draw(0.05), none = Vector3d::Zero();
    const Vector3d turn_a = draw(0.5), turn_b = draw(0.5);

    // Time, place of the wrist, rotation, shape of the hand.
    const HandAngles &open = plan.open, &held = plan.held;
    return {{0.0, start, none, open_relaxed()}, {0.7, before, none, open},         {1.3, grasp, none, open},
            {kGrasped, grasp, none, held},      {2.6, lifted, turn_a, held},       {3.4, carried, turn_b, held},
            {4.1, grasp, none, held},           {kReleasing, grasp, none, held},   {4.6, grasp, none, open},
            {5.0, before, none, open},          {5.3, start, none, open_relaxed()}};
  }

  std::string_view type_;
  SE3 T_camera_grasp_, T_palm_object_;
  std::vector<SceneObject> objects_;
  std::unique_ptr<HandTrack> track_;
};

}  // namespace

HandShape drawn_hand(const HandShape& shape, std::uint64_t seed) {
  KeyedRandom random = random_for(Stream::shape, seed);
  HandShape hand = shape;
  hand.scale *= random.uniform(0.88, 1.12);
  hand.thickness *= random.uniform(0.92, 1.08);
  for (double* length : {&hand.thumb, &hand.index, &hand.middle, &hand.ring, &hand.little})
    *length *= random.uniform(0.95, 1.05);
  return hand;
}

Result<std::unique_ptr<Sequence>> make_varied_grasp(const HandRig& rig, const GraspChoice& choice, std::uint64_t seed) {
  const auto chosen = drawn(choice, seed);
  if (!chosen) return tl::unexpected(chosen.error());
  auto plan = plan_grasp(rig, chosen->type, chosen->object, seed);
  if (!plan) return tl::unexpected(plan.error());
  return std::make_unique<VariedGrasp>(std::move(*plan), grasp_types()[chosen->type].name, seed);
}

}  // namespace barehand::synthetic
