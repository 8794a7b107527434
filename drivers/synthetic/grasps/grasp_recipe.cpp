#include "drivers/synthetic/grasps/grasp_recipe.h"

#include "math/angles.h"

namespace barehand::synthetic {

// How each class of grasp is made.

namespace {

using Eigen::Vector3d;

constexpr int kThumb = 0, kIndex = 1, kMiddle = 2, kRing = 3, kLittle = 4;

FingerAngles finger(double abduction, double first, double second, double third) {
  return {abduction * kDegree, {first * kDegree, second * kDegree, third * kDegree}};
}

/// The pad of a fingertip, and the palmar side of the phalanx before it.
Touch pad(int finger) { return {segment_of(finger, 2), 0.55, -Vector3d::UnitY()}; }
Touch middle_pad(int finger) { return {segment_of(finger, 1), 0.5, -Vector3d::UnitY()}; }
/// The side of a phalanx that faces the thumb (1) or the little finger (-1).
Touch side(int finger, int phalanx, double along, double towards_thumb) {
  return {segment_of(finger, phalanx), along, {-towards_thumb, 0, 0}};
}
std::vector<Touch> pads(int first, int last) {
  std::vector<Touch> list;
  for (int f = first; f <= last; ++f) list.push_back(pad(f));
  return list;
}

/// Opening of the thumb and the fingers up to `last`, which close by bending; the other fingers keep still.
HandAngles bending(int last, double thumb, double fingers) {
  HandAngles opening;
  opening[kThumb] = finger(0, -thumb, -0.5 * thumb, -0.4 * thumb);
  for (int f = kIndex; f <= last; ++f) opening[f] = finger(0, -fingers, -0.6 * fingers, -0.2 * fingers);
  return opening;
}

const FingerAngles kBent = finger(0, 50, 40, 18), kCurled = finger(-2, 60, 75, 40), kLoose = finger(-2, 25, 30, 15);
const FingerAngles kFist = finger(0, 88, 102, 60), kThumbOpposed = finger(26, 8, 12, 15);

/// A grasp in which the palm opposes the fingers.
GraspRecipe palm(std::vector<Fit> fits, const Vector3d& along, const Vector3d& at_palm, const HandAngles& open,
                 const HandAngles& closed) {
  GraspRecipe recipe;
  recipe.fits = std::move(fits);
  recipe.along = along;
  recipe.at_palm = at_palm;
  recipe.comfortable = open;
  recipe.closed = closed;
  return recipe;
}

/// A grasp that holds the object between the thumb, or a finger, and other fingers.
GraspRecipe opposed(std::vector<Fit> fits, std::vector<Touch> first, std::vector<Touch> second, const Vector3d& along,
                    const HandAngles& comfortable, const HandAngles& opening) {
  GraspRecipe recipe;
  recipe.fits = std::move(fits);
  recipe.first = std::move(first);
  recipe.second = std::move(second);
  recipe.along = along;
  recipe.comfortable = comfortable;
  recipe.opening = opening;
  recipe.least_abduction = 8 * kDegree;
  recipe.most_abduction = 40 * kDegree;
  return recipe;
}

GraspRecipe wrap() {
  const FingerAngles open = finger(0, 2, 6, 5);
  return palm({{HoldKind::rod, 0.045, 0.085, 1, 0.05}, {HoldKind::ball, 0.06, 0.08}}, -Vector3d::UnitX(),
              {-0.012, -0.12, -0.085},
              {finger(18, -18, -4, 0), finger(5, 2, 6, 5), open, finger(3, 2, 6, 5), finger(6, 2, 6, 5)},
              {finger(26, 30, 45, 55), kFist, kFist, kFist, kFist});
}

GraspRecipe index_extension() {
  const FingerAngles open = finger(0, 14, 16, 9);
  return palm({{HoldKind::rod, 0.014, 0.032, 1, 0.09}}, {-0.5, -0.1, -0.86}, {-0.006, -0.10, -0.086},
              {finger(-6, -4, 0, 0), finger(12, 10, 6, 3), open, open, open},
              {finger(0, 24, 20, 10), finger(14, 70, 24, 8), kFist, kFist, kFist});
}

GraspRecipe thumb_along() {
  const FingerAngles open = finger(0, 14, 16, 9);
  return palm({{HoldKind::rod, 0.018, 0.036, 1, 0.09}}, {-0.85, 0, -0.5}, {-0.004, -0.10, -0.090},
              {finger(-6, -4, 0, 0), open, open, open, open}, {finger(0, 24, 20, 10), kFist, kFist, kFist, kFist});
}

GraspRecipe ring() {
  return opposed({{HoldKind::rod, 0.024, 0.05, 0.06}}, {pad(kThumb)}, {pad(kIndex), middle_pad(kIndex)},
                 Vector3d::UnitX(), {kThumbOpposed, finger(0, 50, 55, 35), kLoose, kLoose, kLoose},
                 bending(kIndex, 14, 18));
}

GraspRecipe sphere_3() {
  const FingerAngles around = finger(2, 40, 55, 35);
  return opposed({{HoldKind::ball, 0.038, 0.06}}, {pad(kThumb)},
                 {pad(kIndex), middle_pad(kIndex), pad(kMiddle), middle_pad(kMiddle)}, -Vector3d::UnitX(),
                 {kThumbOpposed, around, around, kCurled, kCurled}, bending(kMiddle, 14, 18));
}

GraspRecipe sphere_4() {
  const FingerAngles around = finger(2, 35, 50, 32);
  return opposed({{HoldKind::ball, 0.05, 0.076}}, {pad(kThumb)},
                 {pad(kIndex), middle_pad(kIndex), pad(kMiddle), middle_pad(kMiddle), pad(kRing), middle_pad(kRing)},
                 -Vector3d::UnitX(), {kThumbOpposed, around, around, around, finger(4, 60, 60, 35)},
                 bending(kRing, 14, 18));
}

/// The pads of all fingers and the phalanges before them, for fingers that lie flat on something.
std::vector<Touch> flat_fingers() {
  std::vector<Touch> list;
  for (int f = kIndex; f <= kLittle; ++f) {
    list.push_back(pad(f));
    list.push_back(middle_pad(f));
  }
  return list;
}

GraspRecipe extension() {
  const FingerAngles flat = finger(0, 50, 10, 5);
  return opposed({{HoldKind::slab, 0.003, 0.036, 0.3, 0.1}}, {pad(kThumb)}, flat_fingers(), Vector3d::UnitZ(),
                 {finger(30, 14, 6, 6), flat, flat, flat, flat}, bending(kLittle, 12, 10));
}

GraspRecipe adduction() {
  HandAngles scissors;
  scissors[kIndex].abduction = 7 * kDegree;
  scissors[kMiddle].abduction = -4 * kDegree;
  return opposed({{HoldKind::rod, 0.006, 0.012}}, {side(kIndex, 1, 0.6, -1)}, {side(kMiddle, 1, 0.6, 1)},
                 Vector3d::UnitY(),
                 {finger(14, 0, 8, 10), finger(4, 16, 20, 10), finger(-2, 18, 24, 12), kLoose, kLoose}, scissors);
}

GraspRecipe tripod_variation() {
  GraspRecipe recipe = opposed(
      {{HoldKind::rod, 0.006, 0.012}}, {pad(kThumb)}, {side(kMiddle, 2, 0.4, 1)}, Vector3d::UnitY(),
      {kThumbOpposed, finger(10, 40, 35, 15), finger(-2, 48, 48, 22), kCurled, kCurled}, bending(kMiddle, 12, 10));
  recipe.rest = Touch{segment_of(kMiddle, 0), 0.65, Vector3d(-0.85, 0.53, 0)};
  return recipe;
}

GraspRecipe lateral_tripod() {
  GraspRecipe recipe =
      opposed({{HoldKind::rod, 0.006, 0.014}}, {pad(kThumb), pad(kIndex)},
              {side(kMiddle, 2, 0.4, 1), side(kRing, 2, 0.7, 1)}, Vector3d::UnitY(),
              {finger(22, 10, 20, 30), finger(0, 50, 40, 20), finger(-2, 56, 60, 30), finger(-2, 52, 50, 25), kCurled},
              bending(kRing, 12, 10));
  recipe.rest = Touch{segment_of(kIndex, 0), 0.35, Vector3d(-0.95, 0.3, 0)};
  return recipe;
}

GraspRecipe lateral() {
  HandAngles press;
  press[kThumb] = finger(0, -14, -8, -8);
  press[kIndex] = finger(-5, 0, 0, 0);
  GraspRecipe recipe =
      opposed({{HoldKind::slab, 0.0008, 0.009, 0.09}}, {pad(kThumb)}, {side(kIndex, 1, 0.7, 1)}, {0.4, 0.3, 0.9},
              {finger(-4, 10, 15, 20), finger(0, 45, 62, 35), kCurled, kCurled, kCurled}, press);
  recipe.least_abduction = -20 * kDegree;
  recipe.most_abduction = 12 * kDegree;
  return recipe;
}

GraspRecipe pinch() {
  return opposed({{HoldKind::slab, 0.0008, 0.022, 0.09}, {HoldKind::ball, 0.008, 0.024}}, {pad(kThumb)}, {pad(kIndex)},
                 Vector3d::UnitZ(), {kThumbOpposed, kBent, kLoose, kLoose, kLoose}, bending(kIndex, 12, 12));
}

GraspRecipe tripod() {
  return opposed(
      {{HoldKind::ball, 0.012, 0.034}, {HoldKind::rod, 0.006, 0.022, 0.23}, {HoldKind::slab, 0.01, 0.03, 0.06}},
      {pad(kThumb)}, pads(kIndex, kMiddle), Vector3d::UnitX(), {kThumbOpposed, kBent, kBent, kCurled, kCurled},
      bending(kMiddle, 12, 12));
}

GraspRecipe quadpod() {
  return opposed({{HoldKind::ball, 0.025, 0.046}, {HoldKind::rod, 0.006, 0.032, 0.23}}, {pad(kThumb)},
                 pads(kIndex, kRing), Vector3d::UnitX(), {kThumbOpposed, kBent, kBent, kBent, kCurled},
                 bending(kRing, 12, 12));
}

GraspRecipe five_fingers() {
  return opposed({{HoldKind::rod, 0.006, 0.075, 0.23, 0.05}, {HoldKind::ball, 0.05, 0.075}}, {pad(kThumb)},
                 pads(kIndex, kLittle), Vector3d::UnitX(), {kThumbOpposed, kBent, kBent, kBent, kBent},
                 bending(kLittle, 12, 12));
}

GraspRecipe parallel_extension() {
  const FingerAngles straight = finger(-2, 50, 6, 4);
  GraspRecipe recipe =
      opposed({{HoldKind::slab, 0.006, 0.018, 0.3, 0.1}}, {pad(kThumb)}, flat_fingers(), Vector3d::UnitZ(),
              {finger(7, 38, 0, -4), straight, straight, straight, straight}, bending(kLittle, 12, 10));
  recipe.least_abduction = 6 * kDegree;
  recipe.most_abduction = 9 * kDegree;
  return recipe;
}

GraspRecipe writing_tripod() {
  GraspRecipe recipe = opposed(
      {{HoldKind::rod, 0.006, 0.014}}, {pad(kThumb), pad(kIndex)}, {side(kMiddle, 2, 0.5, 1)}, Vector3d::UnitY(),
      {kThumbOpposed, finger(0, 45, 45, 15), finger(-1, 50, 55, 25), kCurled, kCurled}, bending(kMiddle, 12, 10));
  recipe.rest = Touch{segment_of(kIndex, 0), 0.35, Vector3d(-0.95, 0.3, 0)};
  return recipe;
}

}  // namespace

const std::vector<GraspRecipe>& grasp_recipes() {
  static const std::vector<GraspRecipe> kRecipes = {
      wrap(),         index_extension(),    thumb_along(),    ring(),    sphere_3(), sphere_4(), extension(),
      adduction(),    tripod_variation(),   lateral_tripod(), lateral(), pinch(),    tripod(),   quadpod(),
      five_fingers(), parallel_extension(), writing_tripod()};
  return kRecipes;
}

}  // namespace barehand::synthetic
