// Sequences in which a hand grasps an object: a mug, a ball or pliers.
#include <cmath>

#include "drivers/synthetic/random_keys.h"
#include "drivers/synthetic/rendering/shapes.h"
#include "drivers/synthetic/rendering/stage_set.h"
#include "drivers/synthetic/sequences/grasp_planner.h"
#include "math/angles.h"
#include "math/random.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

/// An object and the way in which a right hand grasps it.
struct GraspPlan {
  std::vector<SceneObject> objects;  ///< the grasped object first, then the objects that it stands on
  std::vector<SE3> T_world_stand;    ///< poses of the objects that it stands on
  SignedDistance distance;           ///< distance from the grasped object's surface
  HandAngles open, closed;           ///< the hand before the grasp, and closed as far as possible
  SE3 T_palm_object;                 ///< start of the search for the pose at which the object touches the palm
  Vector3d towards_palm_out;  ///< direction along which this search moves the object, away from the palm (palm frame)
  SE3 T_world_object;         ///< pose of the object at rest
};

/// The rotation matrix with these x and y axes.
Eigen::Matrix3d axes(const Vector3d& x, const Vector3d& y) {
  Eigen::Matrix3d R;
  R << x, y, x.cross(y);
  return R;
}

/// An open hand before a grasp; angles in degrees.
HandAngles preshape(double thumb_abduction, double knuckle, double middle, double tip) {
  HandAngles angles;
  angles[0] = {thumb_abduction * kDegree, {-14 * kDegree, 0, 4 * kDegree}};
  const std::array<double, 4> spread = {6, 0, 3, 7};
  for (int finger = 1; finger < kFingerCount; ++finger)
    angles[finger] = {spread[finger - 1] * kDegree, {knuckle * kDegree, middle * kDegree, tip * kDegree}};
  return angles;
}

/// The hand closed as far as possible; angles in degrees.
HandAngles closed_shape(double thumb_abduction) {
  HandAngles angles = preshape(thumb_abduction, 88, 102, 60);
  angles[0] = {thumb_abduction * kDegree, {28 * kDegree, 45 * kDegree, 55 * kDegree}};
  return angles;
}

/// Grasp of a vertical cylinder: the mug's axis lies across the palm, and the thumb is on top.
GraspPlan plan_mug() {
  // Choose the orientation of the palm.
  const MugSize size;
  GraspPlan plan;
  const double heading = 128 * kDegree;  // direction of the fingers on the table
  const Vector3d up = Vector3d::UnitZ(), fingers(std::cos(heading), std::sin(heading), 0);
  const Vector3d x_palm = -up, y_palm = (-fingers).cross(x_palm);
  const Eigen::Matrix3d R_world_palm = axes(x_palm, y_palm);

  // The handle is on the side away from the palm, a little towards the wrist.
  const Vector3d handle = (0.86 * -y_palm - 0.5 * fingers).normalized();
  const Eigen::Matrix3d R_world_object = axes(handle, up.cross(handle));

  // Place the mug, and choose the shapes of the hand before and after the grasp.
  plan.objects = {{"mug", make_mug(size), {{182, 48, 40}, 0.6}}};
  plan.distance = cylinder_distance(size.radius, size.height / 2);
  plan.T_world_object = {R_world_object, {0.02, 0.03, size.height / 2}};
  plan.T_palm_object = {R_world_palm.transpose() * R_world_object, {-0.012, -0.12, -0.085}};
  plan.towards_palm_out = -Vector3d::UnitY();
  plan.open = preshape(2, 14, 14, 8);
  plan.closed = closed_shape(14);
  return plan;
}

/// Power grasp of a 65 mm ball on a post, from above and from the side.
GraspPlan plan_ball() {
  // Choose the orientation of the palm.
  constexpr double kRadius = 0.0325, kPost = 0.07;
  GraspPlan plan;
  const Vector3d fingers = Vector3d(-0.82, 0.12, -0.42).normalized();
  const Vector3d across = Vector3d(0.18, 0.93, 0.3);
  const Vector3d x_palm = (across - across.dot(fingers) * fingers).normalized();
  const Eigen::Matrix3d R_world_palm = axes(x_palm, (-fingers).cross(x_palm));

  // Make the grasped object and what it rests on, and place them.
  const Eigen::Vector2d outline[] = {{1e-6, 0}, {0.022, 0}, {0.022, 0.004}, {0.007, 0.006}, {0.005, kPost}};
  plan.objects = {{"ball", make_sphere(kRadius), {{176, 190, 38}}}, {"post", make_turned(outline), {{52, 52, 58}}}};
  plan.T_world_object = {Eigen::Matrix3d::Identity(), {0, 0.02, kPost + kRadius - 0.001}};
  plan.T_world_stand = {{Eigen::Matrix3d::Identity(), {0, 0.02, 0}}};

  // Choose where the search for the contact starts, and the shapes of the hand.
  plan.distance = sphere_distance(kRadius);
  plan.T_palm_object = {R_world_palm.transpose(), {-0.010, -0.10, -0.090}};
  plan.towards_palm_out = -Vector3d::UnitY();
  plan.open = preshape(26, 14, 18, 10);
  plan.closed = closed_shape(30);
  return plan;
}

/// Grasp of pliers that lie in a rack with one handle above the other; the hand closes around both handles.
GraspPlan plan_pliers() {
  // Set the size and the height of the pliers, and the orientation of the palm.
  const PliersSize size;
  constexpr double kHeight = 0.11;
  GraspPlan plan;
  const Vector3d fingers = Vector3d(-0.9, 0.25, -0.25).normalized();
  const Vector3d across = Vector3d(0.25, 0.95, 0);
  const Vector3d x_palm = (across - across.dot(fingers) * fingers).normalized();
  const Eigen::Matrix3d R_world_palm = axes(x_palm, (-fingers).cross(x_palm));

  // Approximate the handles by tubes, which have a simple signed distance.
  std::vector<Vector3d> upper = {{-0.3 * size.length, 0, 0}, {0.0, 0.0125, 0}, {0.4 * size.length, 0.0145, 0}};
  std::vector<Vector3d> lower = upper;
  for (Vector3d& p : lower) p.y() = -p.y();

  // Make the grasped object and what it rests on, and place them.
  plan.objects = {{"pliers", make_pliers(size), {{196, 60, 32}, 0.3}},
                  {"rack", make_box({0.012, 0.02, 0.045}), {{92, 74, 56}}}};
  plan.T_world_object = {R_world_palm, {0.0, 0.03, kHeight}};
  const Vector3d jaws = plan.T_world_object * Vector3d(-0.45 * size.length, 0, 0);
  plan.T_world_stand = {{Eigen::Matrix3d::Identity(), {jaws.x(), jaws.y(), 0.045}}};

  // Choose where the search for the contact starts, and the shapes of the hand.
  plan.distance = union_of({tube_distance(upper, size.handle_radius), tube_distance(lower, size.handle_radius)});
  plan.T_palm_object = {Eigen::Matrix3d::Identity(), {0.006, -0.08, -0.082}};
  plan.towards_palm_out = -Vector3d::UnitY();
  plan.open = preshape(20, 24, 26, 12);
  plan.closed = closed_shape(28);
  return plan;
}

GraspPlan plan_for(GraspedShape shape) {
  if (shape == GraspedShape::mug) return plan_mug();
  return shape == GraspedShape::ball ? plan_ball() : plan_pliers();
}

/// A hand that reaches for an object, grasps, lifts, turns, lowers and releases it, and withdraws. Times in seconds.
class GraspSequence : public Sequence {
 public:
  GraspSequence(const HandRig& rig, GraspPlan plan, std::uint64_t seed)
      : T_camera_world_(camera_above_table(46 * kDegree, 0.60, 0.13)),
        objects_(std::move(plan.objects)),
        T_world_stand_(plan.T_world_stand),
        T_world_object_(plan.T_world_object) {
    // Plan the grasp once; the contact stays the same while the object is held.
    const GraspPlanner planner(rig);
    T_palm_object_ = planner.place_at_palm(plan.T_palm_object, plan.towards_palm_out, plan.distance, plan.open);
    T_world_grasp_ = T_world_object_ * T_palm_object_.inverse();
    held_ = planner.close(plan.open, plan.closed, T_palm_object_, plan.distance);
    track_ = std::make_unique<HandTrack>(T_world_grasp_.R, keys(plan.open, seed));
    objects_.front().grasped = true;
    objects_.push_back(make_table());
  }

  double duration() const override { return 6.7; }
  const std::vector<SceneObject>& objects() const override { return objects_; }
  std::string_view grasp_type() const override { return "wrap"; }

  SceneState at(double time) const override {
    // Move the palm along its track.
    HandState hand{track_->at(time)};
    const SE3 T_world_palm = hand.skeleton.T_camera_palm;  // the track is given in the world frame
    hand.skeleton.T_camera_palm = T_camera_world_ * T_world_palm;

    // Move the object with the palm while it is held.
    SceneState state;
    state.held = time > kGrasped && time < kReleasing;
    state.T_camera_object.push_back(T_camera_world_ * (state.held ? T_world_palm * T_palm_object_ : T_world_object_));
    for (const SE3& T : T_world_stand_) state.T_camera_object.push_back(T_camera_world_ * T);
    state.T_camera_object.push_back(T_camera_world_);  // the table

    // Move the elbow 0.8 times as far as the wrist.
    const Vector3d elbow_at_grasp = T_world_grasp_ * Vector3d(0, 0.03, 0.38);
    hand.elbow = T_camera_world_ * Vector3d(elbow_at_grasp + 0.8 * (T_world_palm.t - T_world_grasp_.t));
    state.hands = {hand};
    return state;
  }

 private:
  // The object is held between these times [s].
  static constexpr double kGrasped = 2.7, kReleasing = 5.3;

  std::vector<HandKey> keys(const HandAngles& open, std::uint64_t seed) const {
    // The seed varies the motion a little.
    KeyedRandom random(seed, 0, 0, static_cast<std::uint32_t>(Draw::variation));
    const auto vary = [&](double size) {
      return Vector3d(random.uniform(-size, size), random.uniform(-size, size), 0);
    };

    // Choose positions and orientations on the way, relative to the grasp.
    const Vector3d grasp = T_world_grasp_.t, outwards = T_world_grasp_.R.col(1), back = T_world_grasp_.R.col(2);
    const Vector3d before = grasp + 0.055 * outwards + 0.035 * back;
    const Vector3d start = grasp + 0.08 * outwards + 0.07 * back + Vector3d(0.04, -0.02, 0.0) + vary(0.01);
    const Vector3d lifted = grasp + Vector3d(-0.02, -0.01, 0.08) + vary(0.015);
    const Vector3d none = Vector3d::Zero(), turn_a(0.15 + random.uniform(-0.08, 0.08), 0.2, 0.25),
                   turn_b(-0.2, -0.15 + random.uniform(-0.08, 0.08), -0.2);

    // List the keyframes: time, position of the wrist, rotation, shape of the hand.
    return {{0.0, start, none, open_relaxed()}, {0.5, start, none, open_relaxed()},
            {1.5, before, none, open},          {2.1, grasp, none, open},
            {kGrasped, grasp, none, held_},     {2.9, grasp, none, held_},
            {3.5, lifted, turn_a, held_},       {4.2, lifted + Vector3d(0.03, 0.0, 0.01), turn_b, held_},
            {5.0, grasp, none, held_},          {kReleasing, grasp, none, held_},
            {5.7, grasp, none, open},           {6.1, before, none, open},
            {6.6, start, none, open_relaxed()}};
  }

  SE3 T_camera_world_;
  std::vector<SceneObject> objects_;
  std::vector<SE3> T_world_stand_;
  SE3 T_world_object_, T_palm_object_, T_world_grasp_;
  HandAngles held_;
  std::unique_ptr<HandTrack> track_;
};

}  // namespace

std::unique_ptr<Sequence> make_grasp(const HandRig& rig, GraspedShape shape, std::uint64_t seed) {
  return std::make_unique<GraspSequence>(rig, plan_for(shape), seed);
}

}  // namespace barehand::synthetic
