#include "hand/implicit_hand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hand/joint_angles.h"
#include "math/angles.h"

namespace barehand {
namespace {

// Builds the hand's implicit surface from elliptic tubes.

// How an average hand deviates from linear interpolation between the cross-sections that a profile states. The numbers
// were fitted to depth images of several hands in known poses; factors multiply the profile's own sections.

// Widths of the smooth transitions between tubes [m] (see smooth_min()).
constexpr double kPalmBlend = 0.0072;     // between neighbouring metacarpals
constexpr double kThenarBlend = 0.0158;   // between thumb and palm: the fold of skin
constexpr double kFingerBlend = 0.00342;  // between fingers and palm

// The proximal ends of the four metacarpal tubes, relative to the profile's section at the wrist.
constexpr double kWristSpread = 0.255;     // spread of the tubes to either side, relative to the wrist's half width
constexpr double kWristWidth = 0.603;      // width of one tube, as a fraction of the wrist's
constexpr double kWristThickness = 0.476;  // thickness of one tube, as a fraction of the wrist's
constexpr double kWristOffset = 0.182;     // flesh offset of one tube, as a fraction of the wrist's
constexpr double kWristShift = -0.0423;    // shift towards the little finger, relative to the wrist's half width

// Changes of three of the factors across the palm: added at the little finger and subtracted at the index finger.
constexpr double kWristThicknessSlope = -0.0794;
constexpr double kWristOffsetSlope = -0.12;
constexpr double kHeelThicknessSlope = 0.0268;

// The heel of the hand: the middle section of each metacarpal tube.
constexpr double kHeelWidth = 1.03;       // factor on the interpolated width
constexpr double kHeelAt = 0.362;         // position of the heel, as a fraction of the tube's length
constexpr double kHeelThickness = 0.719;  // thickness of the heel relative to the wrist's (with the thumb's root)
constexpr double kHeelOffset = 0.753;     // flesh offset of the heel relative to the wrist's

// The distal ends of the metacarpal tubes, relative to the finger's section at the knuckle.
constexpr double kKnuckleThickness = 0.867;
constexpr double kKnuckleOffset = 0.863;

// The thumb's metacarpal. The distal section of the profile is mostly palm, so it is moved by the fraction kThenarTaper
// towards the section of the next bone.
constexpr double kThenarTaper = 0.649;
constexpr double kThenarRootShift = 0.0426;  // shift of the root away from the palm, relative to its half width
constexpr double kThenarCap = 0.367;         // factor on the rounding at the distal end

// Distances of the palm's two borders from the outer knuckles, relative to the knuckles' half width.
constexpr double kBorderThumb = 1.03;
constexpr double kBorderLittle = 1.13;

// The webs between neighbouring fingers.
constexpr double kWebBlend = 0.00427;    // width of the smooth transition to fingers and palm [m]
constexpr double kWebAt = 0.232;         // position of a web, as a fraction of the proximal phalanges' length
constexpr double kWebHalfLength = 1.14;  // half length of a web, relative to the fingers' half thickness at the PIP
constexpr double kWebThickness = 0.94;   // half thickness of a web, relative to that half thickness of the fingers
constexpr double kWebOffset = 1.54;      // shift towards the palm (along y), relative to the knuckles' flesh offset

// The web between thumb and index finger. Sizes are relative to the half thickness of the thumb at its next joint.
constexpr double kThumbWebAlongThumb = 0.799;  // where the web begins, as a fraction of the thumb's metacarpal
constexpr double kThumbWebAlongPalm = 0.661;   // where the web ends, as a fraction of the way from wrist to index
constexpr double kThumbWebThickness = 0.484;   // half thickness of the thumb's web
constexpr double kThumbWebHalfLength = 1.18;   // half length of the thumb's web along the bones
constexpr double kThumbWebOffset = -0.35;      // shift of the web's end towards the back of the hand
constexpr double kThumbWebBlend = 0.00821;     // width of the smooth transition to thumb and palm [m]

// A cross-section of a phalanx: at an end relative to the profile's section there, and in the middle relative to the
// section that is interpolated between both ends.
struct SectionShape {
  double width = 1, thickness = 1;  // factors on the half axes
  double rise = 0;                  // shift towards the back of the hand, as a fraction of the half thickness
};
struct PhalanxShape {
  double middle;  // position of the middle section, as a fraction of the length
  double taper;   // interpolation of the middle section: 0 is the proximal section, 1 the distal one
  std::array<SectionShape, 3> sections;  // at the proximal end, in the middle, at the distal end
};
constexpr std::array<PhalanxShape, 3> kThumb = {{
    {.middle = 0.497, .taper = 0.563, .sections = {{{0.961, 0.83, 0.0513}, {1.11, 1.04}, {1.03, 1.05}}}},
    {.middle = 0.412, .taper = 0.594, .sections = {{{1.12, 1}, {0.89, 0.967, 0.0265}, {1.11, 1.04}}}},
    {.middle = 0.768, .taper = 0.594, .sections = {{{}, {1.01, 0.906}, {0.792, 1.12, 0.126}}}},
}};
constexpr std::array<PhalanxShape, 3> kFinger = {{
    {.middle = 0.49, .taper = 0.768, .sections = {{{0.937, 0.909}, {1.02, 1.03}, {1.03, 1}}}},
    {.middle = 0.512, .taper = 0.594, .sections = {{{}, {1, 1.03}, {0.944, 1}}}},
    {.middle = 0.594, .taper = 0.594, .sections = {{{1.02, 1}, {1, 1.01}, {0.954, 1, 0.113}}}},
}};

// Polynomial smooth minimum. It differs from min(a, b) only where |a - b| < k, by at most k / 4.
double smooth_min(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k * 0.25;
}

/// Linear interpolation between two sections.
EllipticSection mix(const EllipticSection& a, const EllipticSection& b, double u) {
  const auto lerp = [u](double x, double y) { return x + u * (y - x); };
  return {lerp(a.half_x, b.half_x), lerp(a.half_y, b.half_y), lerp(a.centre_x, b.centre_x),
          lerp(a.centre_y, b.centre_y)};
}

/// The section that a profile states at an end of a segment.
EllipticSection section_at(const SegmentProfile& s, int end) {
  return {s.half_width[end], s.half_thickness[end], s.flesh_offset_x[end], s.flesh_offset_y[end]};
}

// The hand's rest pose with the fingers fanned out away from the middle finger.
HandPose spread_pose(const HandProfile& profile) {
  std::array<JointAngles, kSegmentCount> angles{};
  const double side = side_sign(profile.handedness);  // positive abduction turns a bone towards -x
  angles[segment_of(1, 0)].abduction = 8 * kDegree * side;
  angles[segment_of(3, 0)].abduction = -8 * kDegree * side;
  angles[segment_of(4, 0)].abduction = -18 * kDegree * side;
  return forward_kinematics(profile, profile.segments[kPalm].T_hand_segment, angles);
}

// A frame at `start` with -z towards `end` and +y close to `up`.
SE3 frame_along(const Eigen::Vector3d& start, const Eigen::Vector3d& end, const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = (start - end).normalized();
  const Eigen::Vector3d x = up.cross(z).normalized();
  SE3 frame{Eigen::Matrix3d::Identity(), start};
  frame.R << x, z.cross(x), z;
  return frame;
}

/// The tube of a phalanx or of the thumb's metacarpal.
EllipticTube phalanx_tube(const HandProfile& profile, const HandPose& pose, int segment) {
  const SegmentProfile& s = profile.segments[segment];
  const bool thumb = finger_of(segment) == 0;
  const PhalanxShape& shape = (thumb ? kThumb : kFinger)[(segment - 1) % 3];

  // Place the tube along the bone.
  EllipticTube tube;
  tube.T_tube_hand = pose[segment].inverse();
  tube.length = s.length;
  tube.middle = shape.middle;

  // Take the profile's sections at the ends, and interpolate the middle section between them.
  const EllipticSection proximal = section_at(s, 0);
  EllipticSection distal = section_at(s, 1);
  if (segment == segment_of(0, 0))
    distal = mix(distal, section_at(profile.segments[segment_of(0, 1)], 0), kThenarTaper);
  tube.sections = {proximal, mix(proximal, distal, shape.taper), distal};

  // Apply the fitted deviations from the profile.
  for (int i = 0; i < 3; ++i) {
    EllipticSection& section = tube.sections[i];
    const SectionShape& change = shape.sections[i];
    section.centre_y += change.rise * section.half_y;
    section.half_x *= change.width;
    section.half_y *= change.thickness;
  }

  // The skin of a fingertip ends one distal radius beyond its bone; other ends only need to meet their neighbour.
  tube.cap = {std::min(s.half_width[0], s.half_thickness[0]),
              is_tip(segment) ? s.radius[1] : std::min(distal.half_x, distal.half_y)};

  if (segment == segment_of(0, 0)) {
    tube.sections[0].centre_x += side_sign(profile.handedness) * kThenarRootShift * proximal.half_x;
    tube.cap[1] *= kThenarCap;
  }
  return tube;
}

// The part of the palm that leads from the wrist to the knuckle of a finger (1 to 4), in a frame whose -z runs along
// it. Its sections reach from the outer border of the hand, or from the neighbouring knuckle, across the neighbouring
// metacarpals.
EllipticTube metacarpal_tube(const HandProfile& profile, const HandPose& pose, int finger) {
  const SE3& T_hand_palm = pose[kPalm];
  const SegmentProfile& palm = profile.segments[kPalm];
  const auto knuckle = [&](int f) { return Eigen::Vector3d(T_hand_palm.inverse() * pose[segment_of(f, 0)].t); };
  const EllipticSection root = section_at(profile.segments[segment_of(finger, 0)], 0);
  const EllipticSection wrist = section_at(palm, 0);

  const double side = side_sign(profile.handedness);  // sign of x at the little finger

  // On the side of a neighbour, the tube extends to the neighbour's bone, which avoids grooves between the metacarpals.
  const double reach_little =
      finger < 4 ? std::abs(knuckle(finger + 1).x() - knuckle(finger).x()) : root.half_x * kBorderLittle;
  const double reach_thumb =
      finger > 1 ? std::abs(knuckle(finger).x() - knuckle(finger - 1).x()) : root.half_x * kBorderThumb;

  // At the wrist, the four tubes begin side by side within the wrist's section.
  const double across = (finger - 2.5) / 1.5;  // -1 below the index finger, 1 below the little finger
  const double slot = (0.75 * across * kWristSpread + kWristShift) * wrist.half_x * side;
  const Eigen::Vector3d start(wrist.centre_x + slot, 0, 0);
  const Eigen::Vector3d end = knuckle(finger);

  // Set the sections at the wrist and at the knuckle.
  EllipticTube tube;
  tube.T_tube_hand = (T_hand_palm * frame_along(start, end, Eigen::Vector3d::UnitY())).inverse();
  tube.length = (end - start).norm();
  tube.middle = kHeelAt;
  tube.sections[0] = {wrist.half_x * kWristWidth, wrist.half_y * (kWristThickness + kWristThicknessSlope * across), 0,
                      wrist.centre_y * (kWristOffset + kWristOffsetSlope * across)};
  tube.sections[2] = {0.5 * (reach_little + reach_thumb), root.half_y * kKnuckleThickness,
                      side * 0.5 * (reach_little - reach_thumb) + root.centre_x * 0.5, root.centre_y * kKnuckleOffset};

  // The heel of the hand is thicker than the wrist and than a straight line to the knuckles.
  tube.sections[1] = mix(tube.sections[0], tube.sections[2], tube.middle);
  tube.sections[1].half_x *= kHeelWidth;
  tube.sections[1].half_y = wrist.half_y * (kHeelThickness + kHeelThicknessSlope * across);
  tube.sections[1].centre_y = wrist.centre_y * kHeelOffset;
  tube.cap = {0.004, std::min(root.half_x, root.half_y) * 0.8};
  return tube;
}

// A tube with a constant cross-section between two points in the hand frame. The section's y axis is close to `up`.
EllipticTube uniform_tube(const Eigen::Vector3d& start, const Eigen::Vector3d& end, const Eigen::Vector3d& up,
                          const EllipticSection& section) {
  EllipticTube tube;
  tube.T_tube_hand = frame_along(start, end, up).inverse();
  tube.length = (end - start).norm();
  tube.sections = {section, section, section};
  tube.cap = {0.002, 0.002};
  return tube;
}

// The fold of skin between a finger and the next one.
Web finger_web(const HandProfile& profile, const HandPose& pose, int finger) {
  const int a = segment_of(finger, 0), b = segment_of(finger + 1, 0);
  const auto anchor = [&](int s) {
    const SegmentProfile& proximal = profile.segments[s];
    return Eigen::Vector3d(pose[s] *
                           (Eigen::Vector3d(0, kWebOffset * proximal.flesh_offset_y[0], 0) + kWebAt * proximal.distal));
  };
  const double thin = std::min(profile.segments[a].half_thickness[1], profile.segments[b].half_thickness[1]);
  const EllipticSection section{kWebHalfLength * thin, kWebThickness * thin, 0, 0};
  return {uniform_tube(anchor(a), anchor(b), pose[a].R.col(1) + pose[b].R.col(1), section), kWebBlend};
}

// The muscle and the fold of skin between thumb and index finger.
Web thumb_web(const HandProfile& profile, const HandPose& pose) {
  const int thumb = segment_of(0, 0), index = segment_of(1, 0);
  const double thick = profile.segments[segment_of(0, 1)].half_thickness[0];
  const Eigen::Vector3d up = pose[kPalm].R.col(1);
  const Eigen::Vector3d start = pose[thumb] * (kThumbWebAlongThumb * profile.segments[thumb].distal);
  const Eigen::Vector3d end =
      pose[kPalm].t + kThumbWebAlongPalm * (pose[index].t - pose[kPalm].t) + kThumbWebOffset * thick * up;
  const EllipticSection section{kThumbWebHalfLength * thick, kThumbWebThickness * thick, 0, 0};
  return {uniform_tube(start, end, up, section), kThumbWebBlend};
}

}  // namespace

double EllipticTube::distance(const Eigen::Vector3d& p_hand) const {
  // Interpolate the section at the point's position along the bone.
  const Eigen::Vector3d p = T_tube_hand * p_hand;
  const double along = -p.z();
  const double u = std::clamp(along / length, 0.0, 1.0);
  const EllipticSection e = u < middle ? mix(sections[0], sections[1], u / middle)
                                       : mix(sections[1], sections[2], (u - middle) / (1 - middle));

  // Compute the ellipsoidal norm of the point, which is 1 on the surface. Beyond an end, the cap's length is the third
  // half axis.
  const double beyond = along < 0 ? along / cap[0] : (along > length ? (along - length) / cap[1] : 0.0);
  const double cap_here = along < 0 ? cap[0] : cap[1];
  const Eigen::Vector3d q((p.x() - e.centre_x) / e.half_x, (p.y() - e.centre_y) / e.half_y, beyond);
  const double rho = q.norm();
  const double slope = Eigen::Vector3d(q.x() / e.half_x, q.y() / e.half_y, q.z() / cap_here).norm();
  if (slope < 1e-9) return -std::min(e.half_x, e.half_y);
  return (rho - 1) * rho / slope;  // first-order distance to the level set rho = 1
}

ImplicitHand::ImplicitHand(const HandProfile& profile) : pose_(spread_pose(profile)) {
  for (int finger = 1; finger < kFingerCount; ++finger) tubes_.push_back(metacarpal_tube(profile, pose_, finger));
  palm_tubes_ = static_cast<int>(tubes_.size());
  for (int s = 1; s < kSegmentCount; ++s) tubes_.push_back(phalanx_tube(profile, pose_, s));
  for (int finger = 1; finger + 1 < kFingerCount; ++finger) webs_.push_back(finger_web(profile, pose_, finger));
  webs_.push_back(thumb_web(profile, pose_));
}

double ImplicitHand::segment_distance(int segment, const Eigen::Vector3d& p) const {
  if (segment != kPalm) return tubes_[palm_tubes_ + segment - 1].distance(p);
  double d = tubes_[0].distance(p);
  for (int i = 1; i < palm_tubes_; ++i) d = smooth_min(d, tubes_[i].distance(p), kPalmBlend);
  return d;
}

double ImplicitHand::distance(const Eigen::Vector3d& p) const {
  // Fingers must not blend with each other, so they are combined by a sharp minimum.
  double d = segment_distance(kPalm, p);
  double fingers = std::numeric_limits<double>::max();

  // Each finger is the minimum of its three segments.
  for (int finger = 0; finger < kFingerCount; ++finger) {
    double chain = std::numeric_limits<double>::max();
    for (int k = 0; k < 3; ++k) chain = std::min(chain, segment_distance(segment_of(finger, k), p));
    if (finger == 0)
      d = smooth_min(d, chain, kThenarBlend);
    else
      fingers = std::min(fingers, chain);
  }

  // Blend the fingers and then the webs into the palm.
  d = smooth_min(d, fingers, kFingerBlend);
  for (const Web& web : webs_) d = smooth_min(d, web.tube.distance(p), web.blend);
  return d;
}

}  // namespace barehand
