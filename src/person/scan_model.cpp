#include "person/scan_model.h"

#include <Eigen/Dense>
#include <algorithm>

#include "hand/implicit_hand.h"
#include "person/skin_sections.h"

namespace barehand {
namespace {

// The model that a scan optimises, and its conversion from and to a hand profile.

using Eigen::Vector3d;
using Eigen::Vector3f;

// Chooses the second segment for a vertex that follows one segment alone: for the palm's skin the nearest finger, for
// a phalanx the nearer neighbour. The thumb's metacarpal lies in the palm's flesh over its whole length, so its
// partner is always the palm.
int partner(const ImplicitHand& hand, const HandProfile& profile, const SkinVertex& v) {
  if (v.a != kPalm) {
    const bool distal_half = -v.in_a.z() > 0.5 * profile.segments[v.a].length;
    return distal_half && !is_tip(v.a) && v.a != segment_of(0, 0) ? v.a + 1 : parent_of(v.a);
  }
  const Vector3d p = hand.pose()[kPalm] * v.in_a.cast<double>();
  int nearest = segment_of(0, 0);
  for (int f = 1; f < kFingerCount; ++f)
    if (hand.segment_distance(segment_of(f, 0), p) < hand.segment_distance(nearest, p)) nearest = segment_of(f, 0);
  return nearest;
}

// How far the skin's end has moved along the bone [m]. It is a least-squares mean over the end's skin, because a
// single vertex may stick out where no frame saw it.
double growth_of_end(const Skin& before, const Skin& now, int segment, const Vector3d& along) {
  constexpr double kEnd = 0.5;  // cosine: normals within this angle of the bone's direction belong to the end
  double end = 0, weight = 1e-9;
  for (std::size_t i = 0; i < now.vertices.size(); ++i) {
    const SkinVertex& v = now.vertices[i];
    const double facing = v.normal_in_a.cast<double>().dot(along);
    if (v.a != segment || facing <= kEnd) continue;
    end += facing * v.normal_in_a.dot(v.in_a - before.vertices[i].in_a);
    weight += facing * facing;
  }
  return end / weight;
}

// Where the bone of a fingertip ends, in the frame that the bone had at the start of the scan. Also sets its radius
// there: the skin ends one radius beyond the bone. If the profile's joints are known, so is the radius, except for the
// growth of the skin.
Vector3d tip_of(const ScanModel& start_model, const ScanModel& model, int segment, SegmentProfile& bone) {
  const Vector3d along = bone.distal.normalized();
  const double end = bone.length + bone.radius[1] + growth_of_end(start_model.skin, model.skin, segment, along);

  // Without enough skin the radius stays as it was.
  const auto now = SkinSections::fit(model.skin, segment, bone.length, false);
  if (!now) return (end - bone.radius[1]) * along;

  // A measured radius may differ from that of the starting model's skin; compute the difference.
  double beside = 0;
  const bool known = model.joints_are_known();
  if (known)
    if (const auto before = SkinSections::fit(start_model.skin, segment, bone.length, false))
      beside = bone.radius[1] - before->radius(1);

  // Solve radius = difference + now->radius(u) with u = (end - radius) / bone.length.
  const double slope = std::max((now->radius(1) - now->radius(0)) / bone.length, -0.5);
  const double radius = (beside + now->radius(0) + slope * end) / (1 + slope);
  bone.radius[1] = std::clamp(radius, 0.5 * bone.radius[1], 2 * bone.radius[1]);
  Vector3d tip = (end - bone.radius[1]) * along;

  // The bone ends in the middle of the skin from side to side.
  if (!known) tip.x() = now->middle_x(-tip.z() / bone.length);
  return tip;
}

// Orders the two segments of a vertex as in a profile's skin: the first one has the larger weight, and a vertex that
// follows one segment alone has that one twice.
void put_in_order(SkinVertex& v) {
  if (v.weight_b > 0.5f) {
    std::swap(v.a, v.b);
    std::swap(v.in_a, v.in_b);
    v.weight_b = 1 - v.weight_b;
  }
  if (v.weight_b > 0) return;
  v.b = v.a;
  v.in_b = v.in_a;
}

}  // namespace

ScanModel make_scan_model(const HandProfile& profile, double cell, const std::stop_token& stop) {
  const ImplicitHand hand(profile);
  const HandPose& bind = hand.pose();  // bind pose, in which both segments put a vertex at the same point
  ScanModel model{profile, make_blended_skin(profile, cell, stop), {}, {}, {}, {}};

  // Give every vertex a second segment.
  for (SkinVertex& v : model.skin.vertices) {
    if (v.a == v.b) {
      v.b = static_cast<std::int16_t>(partner(hand, profile, v));
      v.in_b = (bind[v.b].inverse() * (bind[v.a] * v.in_a.cast<double>())).cast<float>();
    }
    const Eigen::Matrix3d R_b_a = bind[v.b].R.transpose() * bind[v.a].R;
    model.normal_in_b.push_back(R_b_a.cast<float>() * v.normal_in_a);
  }

  // Set the joints to the profile's positions.
  for (int s = 1; s < kSegmentCount; ++s) {
    const SE3 rest = profile.rest_relative(s);
    model.in_parent[s] = rest.t;
    model.rest[s] = rest.R;
  }
  for (Vector3d& joint : model.in_segment) joint.setZero();
  return model;
}

void ScanVariables::apply(const Eigen::VectorXd& step, ScanModel& model) const {
  // Limit the step, since larger ones leave the range in which the equations are a good approximation.
  constexpr float kOffset = 0.004f, kWeight = 0.3f;  // largest changes of an offset [m] and of a skinning weight
  for (int s = 1; s < kSegmentCount; ++s) {
    model.in_parent[s] += step.segment<3>(joint(s));
    model.in_segment[s] += step.segment<3>(joint(s) + 3);
    model.rest[s] = orthonormalised(model.rest[s] * exp_so3(step.segment<3>(joint(s) + 6)));
  }

  // Vertices move along their normals in both of their segments.
  for (int i = 0; i < vertices_; ++i) {
    SkinVertex& v = model.skin.vertices[i];
    const float out = std::clamp(static_cast<float>(step[offset(i)]), -kOffset, kOffset);
    v.in_a += out * v.normal_in_a;
    v.in_b += out * model.normal_in_b[i];
    const float change = std::clamp(static_cast<float>(step[skin_weight(i)]), -kWeight, kWeight);
    v.weight_b = std::clamp(v.weight_b + change, 0.0f, 1.0f);
  }
}

HandProfile scanned_profile(const ScanModel& start_model, const ScanModel& model) {
  HandProfile hand = model.profile;
  hand.origin = ProfileOrigin::measured;

  // Move the segments' frames to the joints.
  for (int s = 1; s < kSegmentCount; ++s) {
    const int parent = parent_of(s);
    const SE3 joint{model.rest[s], model.in_parent[s] - model.in_segment[parent]};
    hand.segments[s].T_hand_segment = hand.segments[parent].T_hand_segment * joint;
  }

  // Set the ends of the bones: the next joint, for the palm the middle finger's knuckle, for a fingertip a point within
  // its skin.
  for (int s = 0; s < kSegmentCount; ++s) {
    SegmentProfile& bone = hand.segments[s];
    const Vector3d& start = model.in_segment[s];
    Vector3d end = bone.distal;

    // Choose the distal end by the kind of the segment.
    if (s == kPalm) {
      end = model.in_parent[segment_of(2, 0)];
    } else if (!is_tip(s)) {
      end = model.in_parent[s + 1];
    } else {
      end = tip_of(start_model, model, s, bone);
    }
    // Shift the elliptic sections against the frame, so that they stay where the skin is.
    const Vector3d shift[2] = {start, end - bone.distal};
    for (int i = 0; i < 2; ++i) {
      bone.flesh_offset_x[i] -= shift[i].x();
      bone.flesh_offset_y[i] -= shift[i].y();
    }
    bone.distal = end - start;
    bone.length = bone.distal.norm();
  }

  // Express the skin in the moved frames.
  Skin skin = model.skin;
  for (SkinVertex& v : skin.vertices) {
    v.in_a -= model.in_segment[v.a].cast<float>();
    v.in_b -= model.in_segment[v.b].cast<float>();
    put_in_order(v);
  }
  compute_normals(hand, skin);
  hand.scanned_skin = std::make_shared<const Skin>(std::move(skin));
  return hand;
}

}  // namespace barehand
