#include "stages/contact/posed_hand.h"

#include <algorithm>
#include <cmath>

#include "hand/skin.h"

namespace barehand {
namespace {

using Eigen::Vector3f;

constexpr int kSkinPoints = 80;         // number of skin points per segment
constexpr double kSkinChange = 0.0005;  // the skin is rebuilt if a bone or a section changes by more than this [m]
constexpr float kWrist = 0.02f;         // skin of the palm nearer to the wrist is left out: a sleeve may cover it [m]
constexpr float kCuff = 0.035f;         // points nearer to the wrist than this belong to the hand or to a sleeve [m]
constexpr float kOwn = 0.004f;  // points closer than this to skin that faces the same way are the hand's own [m]
// Points farther than kOff from all skin points do not belong to the hand [m]. Palm and thumb bulge, and their skin
// points are sparse: there, a point belongs to the hand if it is closer than kApart to a skin point and, along the
// normal, closer than kBulge [m].
constexpr float kOff = 0.009f, kBulge = 0.015f, kApart = 0.025f;

/// Whether the skins of two profiles differ by no more than fractions of a millimetre.
bool alike(const HandProfile& a, const HandProfile& b) {
  if (a.handedness != b.handedness || a.scanned_skin != b.scanned_skin) return false;
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentProfile &x = a.segments[s], &y = b.segments[s];
    double change = std::max((x.distal - y.distal).norm(), (x.T_hand_segment.t - y.T_hand_segment.t).norm());
    for (int end = 0; end < 2; ++end)
      change = std::max({change, std::abs(x.half_width[end] - y.half_width[end]),
                         std::abs(x.half_thickness[end] - y.half_thickness[end]),
                         std::abs(x.flesh_offset_x[end] - y.flesh_offset_x[end]),
                         std::abs(x.flesh_offset_y[end] - y.flesh_offset_y[end])});
    if (change > kSkinChange) return false;
  }
  return true;
}

}  // namespace

void PosedHand::pose(const HandEstimate& estimate) {
  // Build the skin if the profile has changed.
  if (!profile_ || (profile_ != estimate.profile && !alike(*profile_, *estimate.profile))) {
    const HandProfile& profile = *estimate.profile;
    surface_ = profile.scanned_skin ? surface_points(*profile.scanned_skin, profile, kSkinPoints)
                                    : make_cylinder_surface(profile, kSkinPoints);
    capsules_.emplace(profile);
    profile_ = estimate.profile;
  }

  // Transform the skin to the camera frame.
  pose_ = pose_of(estimate.segments);
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentSurface& surface = surface_[s];
    const Eigen::Matrix3f R = pose_[s].R.cast<float>();
    const Vector3f t = pose_[s].t.cast<float>();
    PosedSkin& skin = skin_[s];

    // Transform the segment's points, and sum them up for the centre of the enclosing sphere.
    skin.points.clear();
    skin.normals.clear();
    skin.centre.setZero();
    for (std::size_t i = 0; i < surface.size(); ++i) {
      if (s == kPalm && surface.z[i] > -kWrist) continue;
      skin.points.push_back(R * Vector3f(surface.x[i], surface.y[i], surface.z[i]) + t);
      skin.normals.push_back(R * Vector3f(surface.nx[i], surface.ny[i], surface.nz[i]));
      skin.centre += skin.points.back();
    }

    // Complete the enclosing sphere.
    skin.centre /= static_cast<float>(skin.points.size());
    skin.radius = 0;
    for (const Vector3f& p : skin.points) skin.radius = std::max(skin.radius, (p - skin.centre).norm());
  }
}

bool PosedHand::contains(const Vector3f& p) const {
  if ((pose_[kPalm].inverse() * p.cast<double>()).z() > -kCuff) return true;
  for (int s = 0; s < kSegmentCount; ++s) {
    const PosedSkin& skin = skin_[s];
    const bool bulges = s == kPalm || s == segment_of(0, 0) || s == segment_of(0, 1);
    const float reach = bulges ? kApart : kOff, height = bulges ? kBulge : kOff;
    if ((p - skin.centre).squaredNorm() > (skin.radius + reach) * (skin.radius + reach)) continue;
    for (std::size_t i = 0; i < skin.points.size(); ++i) {
      const Vector3f d = p - skin.points[i];
      if (d.squaredNorm() < reach * reach && std::abs(skin.normals[i].dot(d)) < height) return true;
    }
  }
  return false;
}

bool PosedHand::owns(const SurfacePoint& point) const {
  for (const PosedSkin& skin : skin_) {
    const float reach = skin.radius + kOwn;
    if ((point.p - skin.centre).squaredNorm() > reach * reach) continue;
    for (std::size_t i = 0; i < skin.points.size(); ++i)
      if ((point.p - skin.points[i]).squaredNorm() < kOwn * kOwn && point.n.dot(skin.normals[i]) > 0.5f) return true;
  }
  return false;
}

}  // namespace barehand
