// The sequence of a right and a left hand.
#include "drivers/synthetic/rendering/stage_set.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

/// Two hands that move in the air, each on its own track.
class TwoHandsSequence : public Sequence {
 public:
  TwoHandsSequence(FreeSequence::Setting right, FreeSequence::Setting left)
      : right_(std::move(right)), left_(std::move(left)) {}
  double duration() const override { return right_.duration(); }
  const std::vector<SceneObject>& objects() const override { return right_.objects(); }
  SceneState at(double time) const override {
    SceneState state = right_.at(time);
    state.hands.push_back(left_.at(time).hands.front());
    return state;
  }

 private:
  FreeSequence right_, left_;
};

const Vector3d kElbow(-0.03, 0.25, 0.05);  // elbow relative to the wrist, of a person who faces the camera [m]
const Vector3d kOut(-0.62, 0.1, 0.6);      // a wrist position outside the view [m]

// Both tracks are given as those of right hands, at x < 0, since the left hand is mirrored. The hands pass each other
// twice (at 4.2 s with the right one in front, at 6.5 s with the left one), are fists side by side from 8.0 to 8.9 s,
// and leave the view one after the other.

std::vector<HandKey> right_keys() {
  return {{0.0, {-0.14, 0.09, 0.60}, {0, 0, 0}, fist()},
          {0.2, {-0.14, 0.09, 0.60}, {0, 0, 0}, fist()},
          {0.9, {-0.14, 0.09, 0.60}, {0, 0, 0}, open_spread()},
          {1.2, {-0.14, 0.09, 0.60}, {0, 0, 0}, open_spread()},
          {2.0, {-0.16, 0.08, 0.56}, {0, 0.5, 0}, open_relaxed()},
          {2.7, {-0.17, 0.09, 0.60}, {0.2, -0.2, -0.1}, fist()},
          {3.4, {-0.18, 0.105, 0.54}, {0, 0, 0}, open_joined()},
          {4.9, {0.19, 0.105, 0.54}, {0, 0, 0.1}, open_joined()},
          {5.7, {0.19, 0.075, 0.65}, {0, 0, 0}, open_spread()},
          {7.2, {-0.18, 0.075, 0.65}, {0, 0, 0}, open_relaxed()},
          {8.0, {-0.085, 0.09, 0.60}, {0, 0, 0}, fist()},
          {8.9, {-0.085, 0.09, 0.60}, {0, 0, 0}, fist()},
          {9.5, {-0.15, 0.09, 0.60}, {0, 0, 0}, open_spread()},
          {9.8, {-0.15, 0.09, 0.60}, {0, 0, 0}, open_spread()},
          {10.5, kOut, {0, 0, 0}, open_relaxed()},
          {10.9, kOut, {0, 0, 0}, open_relaxed()},
          {11.7, {-0.14, 0.09, 0.58}, {0, 0, 0}, open_spread()},
          {12.3, {-0.12, 0.10, 0.60}, {0, 0.6, 0}, fist()},
          {12.9, {-0.13, 0.08, 0.57}, {0, 0, 0}, open_spread()},
          {13.6, {-0.14, 0.09, 0.60}, {0, 0, 0}, open_relaxed()}};
}

std::vector<HandKey> left_keys() {
  return {{0.0, kOut, {0, 0, 0}, open_relaxed()},
          {0.9, kOut, {0, 0, 0}, open_relaxed()},
          {1.8, {-0.15, 0.09, 0.60}, {0, 0, 0}, open_spread()},
          {2.4, {-0.13, 0.10, 0.62}, {0, -0.3, 0.1}, fist()},
          {3.0, {-0.15, 0.08, 0.62}, {0, 0, 0}, open_spread()},
          {3.4, {-0.18, 0.075, 0.65}, {0, 0, 0}, open_spread()},
          {4.9, {0.19, 0.075, 0.65}, {0, 0, 0}, open_relaxed()},
          {5.7, {0.19, 0.105, 0.54}, {0, 0, 0}, open_joined()},
          {7.2, {-0.18, 0.105, 0.54}, {0, 0, 0}, open_joined()},
          {8.0, {-0.085, 0.09, 0.60}, {0, 0, 0}, fist()},
          {8.9, {-0.085, 0.09, 0.60}, {0, 0, 0}, fist()},
          {9.5, {-0.14, 0.09, 0.60}, {0, 0, 0}, open_relaxed()},
          {10.1, {-0.14, 0.09, 0.60}, {0, 0.6, 0.1}, fist()},
          {10.7, {-0.15, 0.08, 0.63}, {0, 0, 0}, open_spread()},
          {11.3, {-0.13, 0.10, 0.58}, {0.2, 0, 0}, open_relaxed()},
          {11.7, {-0.14, 0.09, 0.60}, {0, 0, 0}, open_joined()},
          {12.4, kOut, {0, 0, 0}, open_relaxed()},
          {12.8, kOut, {0, 0, 0}, open_relaxed()},
          {13.6, {-0.14, 0.09, 0.60}, {0, 0, 0}, open_spread()}};
}

FreeSequence::Setting setting(std::vector<HandKey> keys, std::uint64_t seed) {
  FreeSequence::Setting s;
  s.duration = 13.6;
  s.keys = std::move(keys);
  s.wrist_to_elbow = kElbow;
  s.seed = seed;
  return s;
}

}  // namespace

std::unique_ptr<Sequence> make_two_hands(std::uint64_t seed) {
  return std::make_unique<TwoHandsSequence>(setting(right_keys(), seed), setting(left_keys(), ~seed));
}

}  // namespace barehand::synthetic
