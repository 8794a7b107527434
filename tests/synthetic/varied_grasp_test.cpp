#include "drivers/synthetic/grasps/varied_grasp.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "drivers/synthetic/grasped_object.h"
#include "drivers/synthetic/grasps/grasp_plan.h"
#include "drivers/synthetic/grasps/grasp_recipe.h"
#include "hand/grasps/grasp_types.h"
#include "tests/synthetic/small_simulator.h"
#include "tests/synthetic/test_hand.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

std::vector<std::string> all_objects() {
  std::vector<std::string> names = object_names(false);
  for (std::string& name : object_names(true)) names.push_back(std::move(name));
  return names;
}

/// Number of edges that do not belong to one triangle in each direction, with vertices at the same place as one.
int open_edges(const TriangleMesh& mesh) {
  using Place = std::array<long long, 3>;
  const auto place = [&](std::uint32_t v) {
    const Eigen::Vector3f& p = mesh.vertices[v];
    return Place{std::llround(1e7 * p.x()), std::llround(1e7 * p.y()), std::llround(1e7 * p.z())};
  };
  std::map<std::pair<Place, Place>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    const std::array<Place, 3> c = {place(t[0]), place(t[1]), place(t[2])};
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    for (int k = 0; k < 3; ++k) {
      ++edges[{c[k], c[(k + 1) % 3]}];
      --edges[{c[(k + 1) % 3], c[k]}];
    }
  }
  return static_cast<int>(std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.second != 0; }));
}

TEST(DailyObjects, AreClosedSolidsOfASizeThatFitsAHand) {
  const std::vector<std::string> names = all_objects();
  EXPECT_GE(names.size(), 15u);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const std::string& name : names) {
    const DailyObject object = make_object(name, 1);
    EXPECT_EQ(open_edges(object.mesh), 0) << name;
    ASSERT_FALSE(object.holds.empty()) << name;

    // The volume is positive: triangles face outward.
    double volume = 0;
    Vector3d lower = Vector3d::Constant(1), upper = -lower;
    for (const Triangle& t : object.mesh.triangles) {
      const auto corner = [&](int k) { return Vector3d(object.mesh.vertices[t[k]].cast<double>()); };
      volume += corner(0).dot(corner(1).cross(corner(2))) / 6;
      lower = lower.cwiseMin(corner(0));
      upper = upper.cwiseMax(corner(0));
    }
    EXPECT_GT(volume, 5e-7) << name;
    EXPECT_GT((upper - lower).maxCoeff(), 0.01) << name;
    EXPECT_LT((upper - lower).maxCoeff(), 0.32) << name;
  }
}

TEST(GraspTypes, AreThe17ClassesWithTheirObjectsForTrainingAndForTesting) {
  ASSERT_EQ(grasp_types().size(), 17u);
  ASSERT_EQ(grasp_recipes().size(), 17u);
  std::set<std::tuple<GraspKind, Opposition, ThumbPosition, int, int>> cells;
  for (int type = 0; type < 17; ++type) {
    const GraspType& t = grasp_types()[type];
    cells.insert({t.kind, t.opposition, t.thumb, t.first_finger, t.last_finger});
    EXPECT_FALSE(objects_for(type, false).empty()) << t.name;
    EXPECT_FALSE(objects_for(type, true).empty()) << t.name;
  }
  EXPECT_EQ(cells.size(), 17u) << "two classes of the taxonomy are the same";
}

class VariedGrasps : public HandTest {};

/// Fingers that should touch the object in this class of grasp.
std::set<int> touching_fingers(const GraspRecipe& recipe) {
  std::set<int> fingers;
  if (recipe.first.empty()) fingers = {1, 2, 3, 4};
  for (const auto* list : {&recipe.first, &recipe.second})
    for (const Touch& touch : *list) fingers.insert(finger_of(touch.segment));
  return fingers;
}

TEST_F(VariedGrasps, TouchTheObjectWithTheFingersOfTheirClassAndDoNotReachThrough) {
  const HandRig hand = rig();
  const Skinner skinner(hand.mesh);
  for (int type = 0; type < 17; ++type) {
    const std::string object = objects_for(type, type % 2 == 1).front();
    const auto plan = plan_grasp(hand, type, object, 1);
    ASSERT_TRUE(plan.has_value()) << plan.error().message();

    // Measure the distances.
    std::vector<Eigen::Vector3f> skin;
    skinner.deform(pose_segments(hand.profile, {SE3{}, plan->held}), skin);
    const GraspedObject grasped(object, plan->object.mesh);
    const HandContacts contacts = grasped.contacts(skin, skinner.vertex_segments(), plan->T_palm_object);

    const std::string what = std::string(grasp_types()[type].name) + " of " + object;
    for (int s = 0; s < kSegmentCount; ++s) EXPECT_GT(contacts[s].distance, -0.004) << what << ", " << kSegmentNames[s];
    for (const int finger : touching_fingers(grasp_recipes()[type])) {
      double nearest = 1;
      for (int k = 0; k < 3; ++k) nearest = std::min(nearest, contacts[segment_of(finger, k)].distance);
      EXPECT_LT(nearest, 0.003) << what << ", finger " << finger;
    }
  }
}

TEST_F(VariedGrasps, RefuseWhatDoesNotExistOrFit) {
  const HandRig hand = rig();
  const auto message = [&](const std::string& object, const std::string& type) {
    const auto made = make_varied_grasp(hand, {object, type}, 1);
    return made ? std::string() : made.error().message();
  };
  EXPECT_THAT(message("anvil", ""), HasSubstr("no object \"anvil\""));
  EXPECT_THAT(message("", "karate"), HasSubstr("writing_tripod"));
  EXPECT_THAT(message("can", "lateral"), HasSubstr("card"));
  EXPECT_EQ(message("can", "wrap"), "");
}

TEST_F(VariedGrasps, DrawObjectsForTestingFromLargeSeedsOnly) {
  const HandRig hand = rig();
  const std::vector<std::string> training = object_names(false), testing = object_names(true);
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto early = make_varied_grasp(hand, {"", "pinch"}, seed);
    const auto late = make_varied_grasp(hand, {"", "pinch"}, kFirstTestSeed + seed);
    EXPECT_THAT(training, testing::Contains((*early)->objects()[0].name));
    EXPECT_THAT(testing, testing::Contains((*late)->objects()[0].name));
  }
}

TEST(VariedGraspSequence, MovesTheObjectWithThePalmWhileItIsHeld) {
  SimulatorParams params = small_scene("grasp");
  params.grasp = "tripod";
  params.seed = 3;
  Simulator simulated = simulator(params);
  EXPECT_EQ(simulated.grasp_type(), "tripod");
  const auto at = [&](std::int64_t number) {
    const SimulatedFrame frame = simulated.render(number);
    return std::pair(*frame.object, frame.hands[0].pose[kPalm].inverse() * frame.object->T_camera_object);
  };

  // At rest before and after; with the palm in between.
  const auto start = at(0), held = at(70), carried = at(100), end = at(155);
  EXPECT_FALSE(start.first.held);
  EXPECT_TRUE(held.first.held && carried.first.held);
  EXPECT_LT((start.first.T_camera_object.t - end.first.T_camera_object.t).norm(), 1e-9);
  EXPECT_LT((held.second.t - carried.second.t).norm(), 1e-6);
  EXPECT_GT((held.first.T_camera_object.t - carried.first.T_camera_object.t).norm(), 0.002);
}

TEST(VariedGraspSequence, OtherSequencesHaveNoChoice) {
  SimulatorParams params = small_scene("fist");
  params.object = "cup";
  const auto made = Simulator::create(params);
  ASSERT_FALSE(made.has_value());
  EXPECT_THAT(made.error().message(), HasSubstr("sim:grasp"));
}

TEST(DrawnHand, DiffersFromSeedToSeedAroundTheOneThatIsGiven) {
  HandShape shape;
  shape.scale = 1.1;
  double least = 2, most = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const HandShape hand = drawn_hand(shape, seed);
    least = std::min(least, hand.scale);
    most = std::max(most, hand.scale);
    EXPECT_EQ(hand.index, drawn_hand(shape, seed).index);
  }
  EXPECT_NEAR(least, 0.88 * 1.1, 0.03);
  EXPECT_NEAR(most, 1.12 * 1.1, 0.03);
}

}  // namespace
}  // namespace barehand::synthetic
