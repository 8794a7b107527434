#include <gtest/gtest.h>

#include "hand/hand_shape.h"
#include "person/scan_prior.h"
#include "person/scan_system.h"
#include "person/skin_scan.h"
#include "support/painted_hand.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

constexpr double kCell = 0.008;  // m, coarse: few unknowns

/// A hand in front of the camera, rotated about its vertical axis and with bent joints [rad].
HandPose shown(const HandProfile& hand, double turn, double mcp, double pip, double thumb) {
  SE3 T_camera_palm = test::facing_pose(hand, 0.4)[kPalm];
  T_camera_palm.R = exp_so3({0, turn, 0}) * T_camera_palm.R;
  std::array<JointAngles, kSegmentCount> angles{};
  for (int finger = 1; finger < kFingerCount; ++finger) {
    angles[segment_of(finger, 0)].flexion = mcp;
    angles[segment_of(finger, 1)].flexion = pip;
    angles[segment_of(finger, 2)].flexion = 0.6 * pip;
  }
  angles[segment_of(0, 1)].flexion = 0.6 * thumb;
  angles[segment_of(0, 2)].flexion = thumb;
  return forward_kinematics(hand, T_camera_palm, angles);
}

std::vector<HandPose> all_shown(const HandProfile& hand) {
  std::vector<HandPose> poses;
  for (const double turn : {0.0, 0.7, -0.7, 3.1, 2.4})
    for (const auto& [mcp, pip, thumb] : {std::tuple(0.1, 0.1, 0.1), {0.1, 1.2, 1.0}, {1.1, 0.2, 0.2}, {0.6, 0.7, 0.6}})
      poses.push_back(shown(hand, turn, mcp, pip, thumb));
  return poses;
}

/// Frames of the hand `person`. Their poses are given as segment poses of the hand `start`.
std::vector<ScanFrame> scan_of(const HandProfile& person, const HandProfile& start) {
  const Skin skin = make_blended_skin(person, 0.004);
  const std::vector<HandPose> poses = all_shown(person), guesses = all_shown(start);
  std::vector<ScanFrame> frames;
  for (std::size_t i = 0; i < poses.size(); ++i) frames.push_back({test::observe_skin(skin, poses[i]), guesses[i]});
  return frames;
}

HandShape shape_with(std::initializer_list<std::pair<const char*, double>> values) {
  HandShape shape = HandShape::Zero();
  for (const auto& [name, value] : values)
    for (int k = 0; k < kShapeCount; ++k)
      if (shape_parameters()[k].name == name) shape[k] = value;
  return shape;
}

class ScanTest : public ::testing::Test {
 protected:
  HandProfile started_as(ProfileOrigin origin) const {
    HandProfile start = *start_;
    start.origin = origin;
    return start;
  }
  const std::shared_ptr<const HandProfile> start_ = test::adult_hand();
  Workers workers_{1};
};

TEST_F(ScanTest, AModelThatNothingChangedIsTheHandItStartedFrom) {
  // With other origins, the fingertips move to the end of the skin.
  const HandProfile start = started_as(ProfileOrigin::measured);
  const HandProfile hand = scanned_profile(make_scan_model(start, kCell), make_scan_model(start, kCell));

  // The skin moves like that of the start ...
  const Skin skin = make_blended_skin(*start_, kCell);
  const HandPose pose = shown(*start_, 0.3, 0.8, 0.7, 0.5);
  std::vector<Eigen::Vector3f> before, after;
  pose_skin(skin, pose, before);
  pose_skin(*hand.scanned_skin, pose, after);
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_LT((before[i] - after[i]).norm(), 1e-6f) << i;

  // ... and the segments are the same.
  EXPECT_EQ(hand.origin, ProfileOrigin::measured);
  for (int s = 0; s < kSegmentCount; ++s) {
    EXPECT_LT((hand.segments[s].T_hand_segment.matrix() - start_->segments[s].T_hand_segment.matrix()).norm(), 1e-9);
    EXPECT_NEAR(hand.segments[s].length, start_->segments[s].length, 1e-6) << s;
  }
}

TEST_F(ScanTest, AJointThatMovesTakesItsFrameAlongAndLeavesTheSkin) {
  // Move a joint within both of its bones.
  ScanModel model = make_scan_model(*start_, kCell);
  const int s = segment_of(1, 1);
  const Vector3d shift(0.001, -0.002, 0.003);  // in the frame of the segment
  model.in_segment[s] = shift;
  model.in_parent[s] += start_->rest_relative(s).R * shift;

  // The frame and the sections follow the joint.
  const HandProfile hand = scanned_profile(make_scan_model(*start_, kCell), model);
  EXPECT_LT((hand.segments[s].T_hand_segment.t - start_->segments[s].T_hand_segment * shift).norm(), 1e-9);
  EXPECT_NEAR(hand.segments[s].flesh_offset_y[0], start_->segments[s].flesh_offset_y[0] - shift.y(), 1e-9);

  // The skin stays where it was.
  HandPose rest, rest_before;
  for (int k = 0; k < kSegmentCount; ++k) {
    rest[k] = hand.segments[k].T_hand_segment;
    rest_before[k] = start_->segments[k].T_hand_segment;
  }
  std::vector<Eigen::Vector3f> before, after;
  pose_skin(make_blended_skin(*start_, kCell), rest_before, before);
  pose_skin(*hand.scanned_skin, rest, after);
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_LT((before[i] - after[i]).norm(), 1e-5f) << i;
}

TEST_F(ScanTest, ABoneThatStandsOtherwiseAtRestTakesItsSkinAlong) {
  // Rotate a bone at rest.
  ScanModel model = make_scan_model(*start_, kCell);
  const int s = segment_of(2, 1);
  const ScanVariables variables(model);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(variables.count());
  step.segment<3>(ScanVariables::joint(s) + 6) << 0.01, -0.02, 0.03;
  variables.apply(step, model);

  // Its frame and everything behind it turn.
  const HandProfile hand = scanned_profile(make_scan_model(*start_, kCell), model);
  const Eigen::Matrix3d turned = start_->rest_relative(s).R * exp_so3({0.01, -0.02, 0.03});
  EXPECT_LT((hand.rest_relative(s).R - turned).norm(), 1e-9);
  EXPECT_LT((hand.rest_relative(s).t - start_->rest_relative(s).t).norm(), 1e-9);
  EXPECT_LT((hand.rest_relative(s + 1).matrix() - start_->rest_relative(s + 1).matrix()).norm(), 1e-9);

  // The skin keeps its place on the bones.
  const Skin before = make_blended_skin(*start_, kCell);
  for (std::size_t i = 0; i < before.vertices.size(); ++i)
    ASSERT_LT((hand.scanned_skin->vertices[i].in_a - before.vertices[i].in_a).norm(), 1e-7f) << i;
}

TEST_F(ScanTest, ATipEndsOneRadiusBeforeItsSkin) {
  const int s = segment_of(1, 2);
  const ScanModel before = make_scan_model(*start_, kCell);
  ScanModel longer = before;
  const Eigen::Vector3f along = start_->segments[s].distal.normalized().cast<float>();
  for (SkinVertex& v : longer.skin.vertices)
    if (v.a == s) v.in_a += 0.002f * std::max(v.normal_in_a.dot(along), 0.0f) * v.normal_in_a;
  const SegmentProfile tip = scanned_profile(before, longer).segments[s];
  EXPECT_NEAR(tip.length - start_->segments[s].length, 0.002, 3e-4);
  EXPECT_NEAR(tip.radius[1], start_->segments[s].radius[1], 3e-4);
}

TEST_F(ScanTest, ATipOfThickerSkinIsFartherFromItsEnd) {
  const int s = segment_of(1, 2);
  const SegmentProfile& old = start_->segments[s];
  const Eigen::Vector3f along = old.distal.normalized().cast<float>();
  for (const auto origin : {ProfileOrigin::measured, ProfileOrigin::fitted}) {
    // Make the skin of a fingertip thicker.
    const ScanModel before = make_scan_model(started_as(origin), kCell);
    ScanModel thicker = before;
    for (SkinVertex& v : thicker.skin.vertices)
      if (v.a == s && v.normal_in_a.dot(along) < 0.5f)
        v.in_a += 0.001f * (v.normal_in_a - v.normal_in_a.dot(along) * along);

    // The radius grows with it, and the end of the skin stays.
    const SegmentProfile tip = scanned_profile(before, thicker).segments[s];
    EXPECT_NEAR(tip.radius[1] - old.radius[1], 0.001, 3e-4);
    EXPECT_NEAR(tip.length + tip.radius[1], old.length + old.radius[1], 1e-4);
  }
}

TEST_F(ScanTest, AFittedRadiusIsThatOfTheSkinAndAMeasuredOneStays) {
  // A hand whose radius at the tip does not agree with its sections, which the skin follows.
  const int s = segment_of(2, 2);
  HandProfile start = *start_;
  const SegmentProfile& bone = start.segments[s];
  const double end = bone.length + bone.radius[1];
  start.segments[s].radius[1] = bone.radius[1] + 0.001;  // the sections, which the skin follows, stay

  // Only a fitted hand gets the radius of the skin.
  for (const auto origin : {ProfileOrigin::measured, ProfileOrigin::fitted}) {
    start.origin = origin;
    const ScanModel model = make_scan_model(start, kCell);
    const SegmentProfile tip = scanned_profile(model, model).segments[s];
    const double mean = 0.5 * (bone.half_width[1] + bone.half_thickness[1]);
    EXPECT_NEAR(tip.radius[1], origin == ProfileOrigin::measured ? bone.radius[1] : mean, 3e-4);
    EXPECT_NEAR(tip.length + tip.radius[1], end + 0.001, 1e-6);
  }
}

TEST_F(ScanTest, AFittedTipLiesInTheMiddleOfItsSkin) {
  const int s = segment_of(3, 2);
  for (const auto origin : {ProfileOrigin::measured, ProfileOrigin::fitted}) {
    const ScanModel before = make_scan_model(started_as(origin), kCell);
    ScanModel aside = before;
    for (SkinVertex& v : aside.skin.vertices)
      if (v.a == s) v.in_a.x() += 0.002f;
    const double moved =
        scanned_profile(before, aside).segments[s].distal.x() - scanned_profile(before, before).segments[s].distal.x();
    EXPECT_NEAR(moved, origin == ProfileOrigin::measured ? 0 : 0.002, 1e-4);
  }
}

TEST_F(ScanTest, FoldsAtTheKnucklesCountLessWhereJointsMove) {
  const HandPose pose = shown(*start_, 0, 0.1, 0.1, 0.1);
  const auto observation = test::observe_skin(make_blended_skin(*start_, 0.004), pose);
  const auto information = [&](ProfileOrigin origin) {  // information about the offset of every vertex in one frame
    const HandProfile hand = started_as(origin);
    const ScanModel model = make_scan_model(hand, kCell);
    const ScanVariables variables(model);
    ScanFrameEquations frame;
    EXPECT_TRUE(frame.linearise({observation, pose}, model, variables, widened_limits(hand, 0.3), true));
    ScanEquations equations;
    equations.set_zero(variables.count());
    frame.add_to(equations);
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(variables.count());
    for (const auto& entry : equations.H)
      if (entry.row() == entry.col()) diagonal[entry.row()] += entry.value();
    return Eigen::VectorXd(diagonal.segment(variables.offset(0), static_cast<int>(model.skin.vertices.size())));
  };

  // The ratio of both cases follows from the two penalties.
  const Eigen::VectorXd moving = information(ProfileOrigin::mean), known = information(ProfileOrigin::measured);
  const ScanModel model = make_scan_model(*start_, kCell);
  int at_knuckles = 0;
  for (int i = 0; i < moving.size(); ++i) {
    const SkinVertex& v = model.skin.vertices[i];
    if (known[i] == 0) continue;
    const double fold = std::min(v.weight_b, 1 - v.weight_b);
    const bool of_finger_and_palm =
        (v.a == kPalm && v.b != segment_of(0, 0)) || (v.b == kPalm && v.a != segment_of(0, 0));
    at_knuckles += of_finger_and_palm && fold > 0.1;
    const double less = of_finger_and_palm ? (1 + 100 * fold * fold) / (1 + 900 * fold * fold) : 1;
    EXPECT_NEAR(moving[i] / known[i], less, 1e-6) << i;
  }
  EXPECT_GT(at_knuckles, 10);
}

/// At a model that explains a frame exactly, the equations are those of the true energy, so that a known change of the
/// unknowns is recovered in one step.
class ScanEquationsTest : public ScanTest {
 protected:
  /// Solves for the change that `change` made to a model that explained the frames exactly.
  enum class Unknown { joint, offset, skin_weight };
  Eigen::VectorXd found_back(Unknown unknown, const std::function<void(ScanModel&)>& change) {
    // A changed model.
    const ScanModel truth = make_scan_model(*start_, kCell);
    ScanModel model = truth;
    change(model);
    const ScanVariables variables(model);
    const auto limits = widened_limits(*start_, 0.3);

    // Only one kind of unknown is free, since an offset may hide the effect of a weight.
    ScanEquations shared;
    shared.set_zero(variables.count());
    const int joints = ScanVariables::kJoints, offsets = static_cast<int>(truth.skin.vertices.size());
    for (int k = 0; k < variables.count(); ++k) {
      const Unknown kind =
          k < joints ? Unknown::joint : (k < joints + offsets ? Unknown::offset : Unknown::skin_weight);
      shared.add(k, k, kind == unknown ? 1.0 : 1e12);
    }

    // Frames of the unchanged model.
    std::vector<ScanFrameEquations> frames;
    for (const HandPose& pose : all_shown(*start_)) {
      const ScanFrame frame{test::observe_skin(truth.skin, pose), pose};
      frames.emplace_back();
      EXPECT_TRUE(frames.back().linearise(frame, model, variables, limits, true));
      frames.back().add_to(shared);
    }
    return ScanSystem(shared, frames, 1, workers_).solve().value();
  }
};

TEST_F(ScanEquationsTest, FindBackHowFarTheSkinStandsOut) {
  // Shift all skin outward.
  const ScanModel truth = make_scan_model(*start_, kCell);
  const ScanVariables variables(truth);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(variables.count());
  for (std::size_t i = 0; i < truth.skin.vertices.size(); ++i) change[variables.offset(static_cast<int>(i))] = 0.001;
  const auto step = found_back(Unknown::offset, [&](ScanModel& model) { variables.apply(change, model); });

  // The step undoes the shift where the skin was seen.
  double sum = 0;
  int seen = 0;
  for (std::size_t i = 0; i < truth.skin.vertices.size(); ++i) {
    const double back = step[variables.offset(static_cast<int>(i))];
    if (std::abs(back) < 1e-6) continue;  // never in view
    sum += back;
    ++seen;
  }
  ASSERT_GT(seen, 200);
  EXPECT_NEAR(sum / seen, -0.001, 0.0002);
}

TEST_F(ScanEquationsTest, PullSkinBackToItsShareOfTwoBones) {
  // Change the weights of the skin about the fingers' second joints, towards the outer bone.
  const ScanModel truth = make_scan_model(*start_, 0.004);
  const ScanVariables variables(truth);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(variables.count());
  for (std::size_t i = 0; i < truth.skin.vertices.size(); ++i) {
    const SkinVertex& v = truth.skin.vertices[i];
    const int inner = std::min(v.a, v.b), outer = std::max(v.a, v.b);
    if (v.weight_b == 0 || finger_of(outer) == 0 || inner != segment_of(finger_of(outer), 0) ||
        parent_of(outer) != inner)
      continue;
    change[variables.skin_weight(static_cast<int>(i))] = v.a == inner ? 0.2 : -0.2;
  }

  // The equations of one frame of the unchanged model.
  ScanModel model = truth;
  variables.apply(change, model);
  const HandPose pose = shown(*start_, 0, 0.1, 0.6, 0.1);
  std::vector<ScanFrameEquations> frames(1);
  ASSERT_TRUE(frames[0].linearise({test::observe_skin(truth.skin, pose), pose}, model, variables,
                                  widened_limits(*start_, 0.3), true));
  ScanEquations shared;
  shared.set_zero(variables.count());
  frames[0].add_to(shared);

  // The optimal step along `change`. A pixel belongs to its nearest vertex, and skin beside the changed one counts
  // more because it follows one bone, so the step is shorter than -1. With twice or half the derivative it would be
  // -0.13 or -0.53.
  const Eigen::VectorXd H_change = ScanSystem(shared, frames, 1, workers_).times(change);
  const double step = shared.g.dot(change) / change.dot(H_change);
  EXPECT_LT(step, -0.2);
  EXPECT_GT(step, -0.35);
}

TEST_F(ScanEquationsTest, FindBackWhereAJointWas) {
  const int s = segment_of(3, 1);
  const Vector3d in_parent(0.001, 0.0005, -0.002), in_segment(-0.0005, 0.001, 0.0015);
  const auto step = found_back(Unknown::joint, [&](ScanModel& model) {
    model.in_parent[s] += in_parent;
    model.in_segment[s] += in_segment;
  });

  // For a hinge that bends about one axis, only the difference along that axis can be recovered.
  const Vector3d found_parent = step.segment<3>(ScanVariables::joint(s)),
                 found = step.segment<3>(ScanVariables::joint(s) + 3);
  EXPECT_NEAR(found_parent.z(), -in_parent.z(), 2e-5);
  EXPECT_NEAR(found_parent.y(), -in_parent.y(), 2e-5);
  EXPECT_NEAR(found.z(), -in_segment.z(), 2e-5);
  EXPECT_NEAR(found.y(), -in_segment.y(), 2e-5);
}

/// The relative rotation of two bones at rest is observable only in frames in which the bones are not rotated about the
/// hinge's axis alone.
TEST_F(ScanEquationsTest, FindBackHowAHingeStoodAtRest) {
  const int s = segment_of(2, 1);
  const Vector3d turn(0, 0.012, -0.008);
  const auto step = found_back(Unknown::joint, [&](ScanModel& model) { model.rest[s] *= exp_so3(turn); });
  const Vector3d found = step.segment<3>(ScanVariables::joint(s) + 6);
  EXPECT_NEAR(found.y(), -turn.y(), 2e-4);
  EXPECT_NEAR(found.z(), -turn.z(), 2e-4);
  EXPECT_LT(step.segment<3>(ScanVariables::joint(segment_of(3, 1)) + 6).norm(), 1e-6);  // its neighbour
}

/// The elimination of the poses gives the same result as if the poses were unknowns of one large system.
TEST_F(ScanEquationsTest, AreSolvedAsTheirWholeMatrixIs) {
  const double cell = 0.012;
  const ScanModel start = make_scan_model(*start_, cell);
  const ScanVariables variables(start);
  const auto limits = widened_limits(*start_, 0.3);
  const auto scan = scan_of(scaled(*start_, 1.03), *start_);
  std::vector<ScanFrameEquations> frames(4);
  ScanEquations shared;
  shared.set_zero(variables.count());

  // The equations of the prior and of some frames.
  add_scan_prior(start, start, variables, false, shared);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    ASSERT_TRUE(frames[i].linearise(scan[i], start, variables, limits, false));
    frames[i].add_to(shared, 2);
  }

  // The matrix, column by column; it is symmetric.
  const ScanSystem system(shared, frames, 2, workers_);
  Eigen::MatrixXd matrix(variables.count(), variables.count());
  for (int k = 0; k < variables.count(); ++k) matrix.col(k) = system.times(Eigen::VectorXd::Unit(variables.count(), k));
  const double asymmetry = (matrix - matrix.transpose()).norm();
  EXPECT_LT(asymmetry, 1e-9 * matrix.norm());

  // A direct solution agrees with the iterative one.
  const Eigen::VectorXd exact = matrix.llt().solve(shared.g);
  const auto solved = system.solve();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(ScanSystem(shared, frames, 2, workers_, stop.get_token()).solve());
  ASSERT_TRUE(solved);
  ASSERT_GT(exact.norm(), 1e-3);
  EXPECT_LT((*solved - exact).norm(), 1e-4 * exact.norm());
}

/// The prior is quadratic except for rotations, so its gradient changes as its matrix predicts; the rotations here are
/// small.
TEST_F(ScanTest, ThePriorsGradientFallsAsItsMatrixSays) {
  // A small change of all unknowns.
  const ScanModel start = make_scan_model(*start_, kCell);
  const ScanVariables variables(start);
  Eigen::VectorXd step(variables.count());
  for (int k = 0; k < step.size(); ++k) step[k] = std::sin(0.7 * k);
  step *= 1e-4;
  ScanModel model = start;
  variables.apply(step, model);
  for (int i = 0; i < static_cast<int>(model.skin.vertices.size()); ++i)  // weights end at 0 and 1
    step[variables.skin_weight(i)] = model.skin.vertices[i].weight_b - start.skin.vertices[i].weight_b;

  // The equations before and after.
  ScanEquations before, after;
  for (auto [at, equations] : {std::pair(&start, &before), {&model, &after}}) {
    equations->set_zero(variables.count());
    add_scan_prior(*at, start, variables, false, *equations);
  }

  // The gradient as the matrix predicts it; damping adds a thousandth.
  const Eigen::VectorXd expected = before.g - ScanSystem(before, {}, 1, workers_).times(step);
  for (int k = 0; k < step.size(); ++k)
    ASSERT_NEAR(after.g[k], expected[k], 0.01 * expected.norm() / std::sqrt(expected.size())) << k;
}

TEST_F(ScanTest, FingersAreRootedInTheMiddleOfTheirSkin) {
  const ScanModel start = make_scan_model(*start_, kCell);

  const ScanVariables variables(start);
  const auto pull = [&](const ScanModel& model,
                        bool hold) {  // the sideways force of the prior on the root of every digit
    ScanEquations equations;
    equations.set_zero(variables.count());
    add_scan_prior(model, start, variables, hold, equations);
    std::array<double, kFingerCount> g;
    for (int f = 0; f < kFingerCount; ++f) g[f] = equations.g[ScanVariables::joint(segment_of(f, 0)) + 3];
    return g;
  };

  // Both points of every root are moved, so that only the prior of the joint and of the skin's middle acts on them.
  ScanModel beside = start;
  for (int f = 0; f < kFingerCount; ++f) {
    const int s = segment_of(f, 0);
    beside.in_segment[s].x() += 0.001;
    beside.in_parent[s] += start.rest[s].col(0) * 0.001;
  }

  const auto free = pull(beside, false), at_start = pull(start, false), held = pull(beside, true);
  for (int f = 1; f < kFingerCount;
       ++f)  // 1 mm with a standard deviation of 1 mm gives a force of 1000 / m; at least half of it must act
    EXPECT_LT(free[f] - at_start[f], held[f] - 500) << f;
  EXPECT_NEAR(free[0] - at_start[0], held[0], 1e-6);
}

TEST_F(ScanTest, FindsAnotherPersonsBonesAndSkin) {
  // A person with other bones and another thickness.
  const HandProfile person = reshaped(*start_, shape_with({{"index_proximal_length", 0.08},
                                                           {"middle_intermediate_length", -0.08},
                                                           {"fingers_thickness", 0.08},
                                                           {"palm_thickness", 0.08}}));
  double before = 0, after = 0;
  std::vector<double> mismatch;

  // Scan.
  const auto hand = scan_hand(*start_, 0.005, scan_of(person, *start_), workers_,
                              [&](const ScanProgress& progress) { mismatch.push_back(progress.mismatch); });
  ASSERT_TRUE(hand);

  // Bones and skin have come closer to the person's.
  for (const int s : {segment_of(1, 0), segment_of(2, 1)}) {
    before += std::abs(start_->segments[s].length - person.segments[s].length);
    after += std::abs(hand->segments[s].length - person.segments[s].length);
  }
  EXPECT_LT(after, 0.5 * before);
  EXPECT_LT(mismatch.back(), 0.5 * mismatch.front());
  EXPECT_LT(mismatch.back(), 0.0006);
}

TEST_F(ScanTest, JointsOfAMeasuredHandStay) {
  const HandProfile measured = started_as(ProfileOrigin::measured);
  const HandProfile thicker = reshaped(measured, shape_with({{"fingers_thickness", 0.08}, {"palm_thickness", 0.08}}));
  std::vector<double> mismatch;
  const auto hand = scan_hand(measured, kCell, scan_of(thicker, measured), workers_,
                              [&](const ScanProgress& progress) { mismatch.push_back(progress.mismatch); });
  ASSERT_TRUE(hand);
  for (int s = 1; s < kSegmentCount; ++s)
    EXPECT_LT((hand->rest_relative(s).matrix() - measured.rest_relative(s).matrix()).norm(), 1e-6) << s;
  EXPECT_LT(mismatch.back(), 0.6 * mismatch.front());
}

TEST_F(ScanTest, TheNumberOfThreadsChangesNothing) {
  std::vector<ScanFrame> frames = scan_of(scaled(*start_, 1.02), *start_);
  frames.resize(4);
  Workers three(3);
  const auto one = scan_hand(*start_, 0.012, frames, workers_), other = scan_hand(*start_, 0.012, frames, three);
  ASSERT_TRUE(one && other);
  for (std::size_t i = 0; i < one->scanned_skin->vertices.size(); ++i)
    ASSERT_EQ(one->scanned_skin->vertices[i].in_a, other->scanned_skin->vertices[i].in_a);
}

TEST_F(ScanTest, EndsWhereItIsToldTo) {
  std::stop_source stop;
  int rounds = 0;
  const auto stop_now = [&](const ScanProgress&) {
    ++rounds;
    stop.request_stop();
  };
  EXPECT_FALSE(scan_hand(*start_, 0.012, scan_of(*start_, *start_), workers_, stop_now, stop.get_token()));
  EXPECT_EQ(rounds, 1);
}

TEST_F(ScanTest, DoesNotBeginIfItIsStoppedBefore) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(make_scan_model(*start_, 0.012, stop.get_token()).skin.vertices.empty());
  const auto never = [](const ScanProgress&) { ADD_FAILURE() << "a round was finished"; };
  EXPECT_FALSE(scan_hand(*start_, 0.012, scan_of(*start_, *start_), workers_, never, stop.get_token()));
}

TEST_F(ScanTest, NoFramesAreNoScan) { EXPECT_FALSE(scan_hand(*start_, kCell, {}, workers_)); }

}  // namespace
}  // namespace barehand
