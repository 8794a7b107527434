#include "drivers/synthetic/grasps/grasp_plan.h"

#include <algorithm>
#include <numbers>

#include "core/quote.h"
#include "drivers/synthetic/grasps/opposition.h"
#include "drivers/synthetic/random_keys.h"
#include "drivers/synthetic/sequences/grasp_planner.h"
#include "hand/grasps/grasp_types.h"
#include "math/angles.h"
#include "math/mesh_distance.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

bool fits(const GraspRecipe& recipe, const Hold& hold) {
  return std::any_of(recipe.fits.begin(), recipe.fits.end(), [&](const Fit& fit) {
    return fit.kind == hold.kind && hold.width >= fit.narrowest && hold.width <= fit.widest &&
           hold.length <= fit.longest && hold.length >= fit.shortest;
  });
}

/// The holds of an object that a grasp fits.
std::vector<Hold> fitting_holds(const GraspRecipe& recipe, const DailyObject& object) {
  std::vector<Hold> holds;
  for (const Hold& hold : object.holds)
    if (fits(recipe, hold)) holds.push_back(hold);
  return holds;
}

/// A lower bound of the distance from the mesh that is exact where it matters, near the surface.
SignedDistance distance_from(const TriangleMesh& mesh) {
  Vector3d lower = Vector3d::Constant(1e9), upper = -lower;
  for (const auto& v : mesh.vertices) {
    lower = lower.cwiseMin(v.cast<double>());
    upper = upper.cwiseMax(v.cast<double>());
  }
  auto exact = std::make_shared<const MeshDistance>(mesh.vertices, mesh.triangles);
  return [=](const Vector3d& p) {
    const double from_box = (lower - p).cwiseMax(p - upper).cwiseMax(0).norm();
    return from_box > 0.01 ? from_box : exact->signed_distance(p);
  };
}

HandAngles sum(const HandAngles& a, const HandAngles& b, double factor) {
  HandAngles angles = a;
  for (int finger = 0; finger < kFingerCount; ++finger) {
    angles[finger].abduction += factor * b[finger].abduction;
    for (int k = 0; k < 3; ++k) angles[finger].flexion[k] += factor * b[finger].flexion[k];
  }
  return angles;
}

/// Angles that differ by a few degrees.
HandAngles varied(const HandAngles& angles, KeyedRandom& random, double size) {
  HandAngles offsets;
  for (FingerAngles& finger : offsets) {
    finger.abduction = random.uniform(-0.4 * size, 0.4 * size);
    for (double& angle : finger.flexion) angle = random.uniform(-size, size);
  }
  return sum(angles, offsets, 1);
}

/// Rotations that do not change a hold: around the axis of a rod, or any rotation of a ball.
Eigen::Matrix3d spin(const Hold& hold, KeyedRandom& random) {
  const double a = random.uniform(0, 2 * std::numbers::pi), b = random.uniform(-1, 1), c = random.uniform(-3, 3);
  if (hold.kind == HoldKind::slab) return Eigen::Matrix3d::Identity();
  if (hold.kind == HoldKind::rod) return exp_so3(a * Vector3d::UnitX());
  return exp_so3(a * Vector3d::UnitX()) * exp_so3(std::acos(b) * Vector3d::UnitY()) * exp_so3(c * Vector3d::UnitX());
}

/// Bends fingers that take no part out of the object's way.
void clear_the_way(const GraspPlanner& planner, const SE3& T_palm_object, const SignedDistance& object,
                   const HandAngles& opening, HandAngles& angles) {
  constexpr double kFree = 0.002;

  // Consider every finger that the opening of the hand does not move at its base.
  for (int finger = 1; finger < kFingerCount; ++finger) {
    const auto nearest = [&] {
      const auto gap = planner.clearance(angles, T_palm_object, object);
      return *std::min_element(gap.begin() + segment_of(finger, 0), gap.begin() + segment_of(finger, 2) + 1);
    };
    const FingerAngles& moves = opening[finger];
    if (moves.flexion[0] != 0 || moves.abduction != 0) continue;

    // Take the shape that differs least from the present one.
    const FingerAngles wanted = angles[finger];
    FingerAngles best = wanted;
    double most = nearest();

    // Bend the finger further and further in both directions until it is free.
    for (double turn = 6 * kDegree; turn < 75 * kDegree && most < kFree; turn += 6 * kDegree)
      for (const double sign : {-1.0, 1.0}) {
        angles[finger] = wanted;
        for (double& angle : angles[finger].flexion)
          angle = std::clamp(angle + sign * turn, -8 * kDegree, 92 * kDegree);

        // Keep the shape that gives the most clearance.
        if (const double gap = nearest(); gap > most) {
          most = gap;
          best = angles[finger];
        }
      }
    angles[finger] = best;
  }
}

/// Slides a slab out of the hand until its edge is clear of the palm and the phalanges next to it. `inward`: how far it
/// is pushed in first [m].
void slide_out(const GraspPlanner& planner, const OpposedGrasp& grasp, const SignedDistance& object, double inward,
               SE3& T_palm_object) {
  constexpr double kFree = 0.001, kFarthest = 0.08;
  constexpr std::array<int, 7> kSegments = {
      kPalm,           segment_of(0, 0), segment_of(0, 1), segment_of(1, 0), segment_of(2, 0), segment_of(3, 0),
      segment_of(4, 0)};
  T_palm_object.t += inward * grasp.T_palm_hold.R.col(0);
  for (double way = 0; way < kFarthest; way += 0.002) {
    const auto gap = planner.clearance(grasp.angles, T_palm_object, object);
    if (std::all_of(kSegments.begin(), kSegments.end(), [&](int s) { return gap[s] > kFree; })) break;
    T_palm_object.t -= 0.002 * grasp.T_palm_hold.R.col(0);
  }
}

/// The direction, in the palm frame, in which the open hand can leave the object best.
Vector3d way_out(const GraspPlanner& planner, const PlannedGrasp& plan, const SignedDistance& object) {
  // List the directions in which the hand may leave the object.
  const std::array<Vector3d, 5> directions = {Vector3d(0, 0.6, 0.8), Vector3d(0, 0, 1), Vector3d(0, 1, 0),
                                              Vector3d(0.7, 0, 0.7), Vector3d(0.7, 0.7, 0)};
  Vector3d best = directions[0];
  double most = -1;

  // Find the least clearance on the way in each direction, and keep the direction where it is largest.
  for (const Vector3d& direction : directions) {
    double least = 1;
    for (const double way : {0.01, 0.025, 0.05, 0.08}) {
      SE3 T_palm_object = plan.T_palm_object;
      T_palm_object.t -= way * direction.normalized();
      const auto gap = planner.clearance(plan.open, T_palm_object, object);
      least = std::min(least, *std::min_element(gap.begin(), gap.end()));
    }

    // Keep the direction if it is clearly better.
    if (least <= most + 0.001) continue;  // keeps the first of equally good ones
    most = least;
    best = direction.normalized();
  }
  return best;
}

/// How bad a grasp is [m]: depth of skin inside the object, and distance of fingers that should touch it but do not.
double faults(const GraspPlanner& planner, const GraspRecipe& recipe, const PlannedGrasp& plan,
              const SignedDistance& object) {
  // Skin may be pressed in a little.
  constexpr double kSoft = 0.001;

  // Sum up how deep the segments lie in the object.
  const auto gap = planner.clearance(plan.held, plan.T_palm_object, object);
  double sum = 0;
  for (const double distance : gap) sum += std::max(0.0, -distance - kSoft);

  // In palm opposition the four fingers should touch; otherwise the fingers of the touches.
  std::array<bool, kFingerCount> touches{};
  for (int finger = 1; finger < kFingerCount; ++finger) touches[finger] = recipe.first.empty();
  for (const auto* list : {&recipe.first, &recipe.second})
    for (const Touch& touch : *list) touches[finger_of(touch.segment)] = true;

  // Add the distances of the fingers that should touch but do not.
  for (int finger = 0; finger < kFingerCount; ++finger) {
    if (!touches[finger]) continue;
    const auto first = gap.begin() + segment_of(finger, 0);
    sum += std::max(0.0, *std::min_element(first, first + 3) - kSoft);
  }
  return sum;
}

/// For palm opposition: pushes the object against the palm, then closes the hand.
void hold_against_palm(const GraspPlanner& planner, const GraspRecipe& recipe, const SE3& T_hold_object,
                       const SignedDistance& distance, KeyedRandom& random, PlannedGrasp& plan) {
  SE3 T_palm_hold;
  const Vector3d x = recipe.along.normalized();
  const Vector3d y = (-Vector3d::UnitY() + x.y() * x).normalized();
  T_palm_hold.R << x, y, x.cross(y);
  T_palm_hold.t = recipe.at_palm;
  plan.open = varied(recipe.comfortable, random, 4 * kDegree);
  plan.T_palm_object = planner.place_at_palm(T_palm_hold * T_hold_object, -Vector3d::UnitY(), distance, plan.open);
  plan.held = planner.close(plan.open, varied(recipe.closed, random, 4 * kDegree), plan.T_palm_object, distance);
}

/// For the other oppositions: finds the hand around the hold, opens it, and closes it until it touches.
void hold_opposed(const HandRig& rig, const GraspPlanner& planner, const GraspRecipe& recipe, const Hold& hold,
                  const SE3& T_hold_object, const SignedDistance& distance, KeyedRandom& random, PlannedGrasp& plan) {
  const OpposedGrasp grasp = Opposition(rig, recipe, hold).solve(varied(recipe.comfortable, random, 6 * kDegree));
  plan.T_palm_object = grasp.T_palm_hold * T_hold_object;
  HandAngles angles = grasp.angles;
  const double inward =
      recipe.second.size() > kFingerCount ? 0.03 : 0;  // towards flat fingers, so that the thumb reaches the slab
  if (hold.kind == HoldKind::slab) slide_out(planner, grasp, distance, inward, plan.T_palm_object);
  clear_the_way(planner, plan.T_palm_object, distance, recipe.opening, angles);
  plan.open = sum(angles, recipe.opening, 1);
  plan.held = planner.close(plan.open, sum(angles, recipe.opening, -1.5), plan.T_palm_object, distance);
}

}  // namespace

bool can_hold(int type, const std::string& object) {
  return !fitting_holds(grasp_recipes()[type], make_object(object, 1)).empty();
}

std::vector<std::string> objects_for(int type, bool for_testing) {
  std::vector<std::string> names;
  for (const std::string& name : object_names(for_testing))
    if (can_hold(type, name)) names.push_back(name);
  return names;
}

Result<PlannedGrasp> plan_grasp(const HandRig& rig, int type, const std::string& name, std::uint64_t seed) {
  // Check that the object has a part that the grasp fits.
  const GraspRecipe& recipe = grasp_recipes()[type];
  if (!can_hold(type, name)) {
    std::vector<std::string> others = objects_for(type, false);
    for (std::string& other : objects_for(type, true)) others.push_back(std::move(other));
    return fail("object=" + name + " cannot be held with grasp=" + std::string(grasp_types()[type].name), "sim:grasp",
                "objects that can be: " + comma_list(others));
  }

  // Choose its size.
  KeyedRandom random(seed, 1, 0, static_cast<std::uint32_t>(Draw::variation));
  PlannedGrasp plan;
  plan.object = make_object(name, random.uniform(0.93, 1.07));
  if (fitting_holds(recipe, plan.object).empty()) plan.object = make_object(name, 1);
  const std::vector<Hold> holds = fitting_holds(recipe, plan.object);
  const SignedDistance distance = distance_from(plan.object.mesh);

  // Try a few ways to hold it, and take the first one that is good, or the best.
  constexpr int kTries = 6;
  constexpr double kGood = 0.0005;
  const GraspPlanner planner(rig);
  PlannedGrasp best;
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < kTries && least > kGood; ++i) {
    const Hold& hold = holds[random.bits() % holds.size()];
    const SE3 T_hold_object = SE3{spin(hold, random), Vector3d::Zero()} * hold.T_object_hold.inverse();

    // Plan it against the palm, or between the fingers.
    if (recipe.first.empty())
      hold_against_palm(planner, recipe, T_hold_object, distance, random, plan);
    else
      hold_opposed(rig, planner, recipe, hold, T_hold_object, distance, random, plan);

    // Keep it if it is the best one so far.
    if (const double wrong = faults(planner, recipe, plan, distance); wrong < least) {
      least = wrong;
      best = plan;
    }
  }
  best.withdrawal = way_out(planner, best, distance);
  return best;
}

}  // namespace barehand::synthetic
