#include "stages/contact/object_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace barehand {
namespace {

using Eigen::Vector3d;

constexpr float kVoxel = 0.0125f;             // surfaces in neighbouring voxels are linked [m]
constexpr int kSpeck = 25;                    // fewer points than this (about 3 cm^2) are no object
constexpr double kSamePlace = 0.05;           // an object moves at most this far between two frames [m]
constexpr std::int64_t kForgotten = 500'000;  // time after which an object that is not seen is forgotten [us]
// A palm that moved so far with the object at the same place in it holds the object; one that the object left by more
// than kLeft does not [m].
constexpr double kCarried = 0.02, kFirm = 0.012, kLeft = 0.03;
constexpr double kPlace = 0.005, kTurn = 1.0;  // deviations of the middle of what is seen [m], and of the turn [rad]

std::uint64_t key_of(int x, int y, int z) {
  const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)) & 0x1fffff; };
  return part(x) << 42 | part(y) << 21 | part(z);
}

}  // namespace

void ObjectTracker::process(std::int64_t utime, const HandEstimates& estimates, const std::vector<bool>& open,
                            std::vector<SurfacePoint>& points, FrameVector<SeenObject>& objects) {
  link(open, points);
  match(utime);

  // Tell the points whose they are.
  for (SurfacePoint& point : points) {
    const Thing& thing = things_[parent_[point.component]];
    point.object = thing.track < 0 ? -1 : tracks_[thing.track].state.id;
  }
  std::erase_if(points, [](const SurfacePoint& point) { return point.object < 0; });

  // Update what was seen, and forget what was not for long.
  for (const Thing& thing : things_)
    if (thing.track >= 0) update(tracks_[thing.track], thing, utime, estimates);
  std::erase_if(tracks_, [&](const Track& track) { return std::abs(utime - track.seen) > kForgotten; });
  for (const Track& track : tracks_)
    if (track.seen == utime) objects.push_back(track.state);
}

/// Joins components with points in the same or in neighbouring voxels.
void ObjectTracker::link(const std::vector<bool>& open, const std::vector<SurfacePoint>& points) {
  parent_.resize(open.size());
  for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = static_cast<std::int32_t>(i);
  const auto root = [&](std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  };

  // List the occupied voxels.
  voxels_.clear();
  for (const SurfacePoint& point : points) {
    const Eigen::Vector3i v = (point.p / kVoxel).array().floor().cast<int>();
    voxels_.emplace_back(key_of(v.x(), v.y(), v.z()), point.component);
  }
  std::sort(voxels_.begin(), voxels_.end());
  voxels_.erase(std::unique(voxels_.begin(), voxels_.end()), voxels_.end());

  // Join what lies in neighbouring voxels, always to the smaller number.
  for (const auto& [key, component] : voxels_) {
    if (parent_.size() < 2) break;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        // Voxels that differ in z alone have successive keys.
        const std::uint64_t first = key + key_of(dx, dy, -1) - key_of(0, 0, 0);
        for (auto at = std::lower_bound(voxels_.begin(), voxels_.end(), std::pair{first, std::int32_t{0}});
             at != voxels_.end() && at->first <= first + 2; ++at) {
          const std::int32_t a = root(component), b = root(at->second);
          parent_[std::max(a, b)] = std::min(a, b);
        }
      }
  }

  // Add up the objects.
  things_.assign(open.size(), {});
  for (std::size_t i = 0; i < parent_.size(); ++i) {
    parent_[i] = root(static_cast<std::int32_t>(i));
    if (open[i]) things_[parent_[i]].open = true;
  }
  for (const SurfacePoint& point : points) {
    Thing& thing = things_[parent_[point.component]];
    const Vector3d p = point.p.cast<double>();
    thing.lower = thing.count > 0 ? Vector3d(thing.lower.cwiseMin(p)) : p;
    thing.upper = thing.count > 0 ? Vector3d(thing.upper.cwiseMax(p)) : p;
    thing.sum += p;
    ++thing.count;
  }
}

/// Gives every object the track that was nearest, or a new one.
void ObjectTracker::match(std::int64_t utime) {
  const std::size_t known = tracks_.size();
  while (true) {
    // Find the nearest pair of an object and a track that are both free.
    Thing* best = nullptr;
    std::size_t best_track = 0;
    double least = kSamePlace;
    for (Thing& thing : things_) {
      if (thing.count < kSpeck || thing.track >= 0) continue;
      for (std::size_t t = 0; t < known; ++t) {
        const double distance = (thing.centre() - tracks_[t].state.T_camera_object.t).norm();
        if (tracks_[t].seen == utime || distance >= least) continue;
        best = &thing, best_track = t, least = distance;
      }
    }
    if (!best) break;
    best->track = static_cast<int>(best_track);
    tracks_[best_track].seen = utime;
  }

  for (Thing& thing : things_) {
    if (thing.count < kSpeck || thing.track >= 0) continue;
    thing.track = static_cast<int>(tracks_.size());
    Track& track = tracks_.emplace_back();
    track.state.id = next_id_++;
    track.seen = track.state.since = utime;
  }
}

void ObjectTracker::update(Track& track, const Thing& thing, std::int64_t utime, const HandEstimates& estimates) {
  SeenObject& state = track.state;
  state.T_camera_object.t = thing.centre();
  state.extent = thing.upper - thing.lower;
  state.covariance = Matrix6d::Zero();
  state.covariance.topLeftCorner<3, 3>().diagonal().setConstant(kPlace * kPlace);
  state.covariance.bottomRightCorner<3, 3>().diagonal().setConstant(kTurn * kTurn);

  // Compare it with the nearest palm.
  const HandEstimate* nearest = nullptr;
  for (const HandEstimatePtr& estimate : estimates) {
    if (estimate->status != TrackStatus::tracking) continue;
    const auto distance = [&](const HandEstimate& hand) {
      return (hand.segments[kPalm].T_camera_segment.t - state.T_camera_object.t).norm();
    };
    if (!nearest || distance(*estimate) < distance(*nearest)) nearest = estimate.get();
  }
  bool held = false;
  if (nearest && !thing.open) {
    const SE3& T_camera_palm = nearest->segments[kPalm].T_camera_segment;
    const Vector3d in_palm = T_camera_palm.inverse() * state.T_camera_object.t;

    // Begin anew with another palm, or if the object has left its place in the palm.
    const double left = track.companion == nearest->hand_id ? (in_palm - track.in_palm).norm()
                                                            : std::numeric_limits<double>::infinity();
    if (left > kLeft) {
      track.companion = nearest->hand_id;
      track.in_palm = in_palm;
      track.palm = T_camera_palm.t;
    }

    // It is held once it was carried, until it leaves.
    held = (state.held && left < kLeft) || (left < kFirm && (T_camera_palm.t - track.palm).norm() > kCarried);
  } else {
    track.companion = -1;
  }

  if (held != state.held) state.since = utime;
  state.held = held;
  state.hand_id = held ? track.companion : -1;
}

}  // namespace barehand
