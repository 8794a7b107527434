// Assigns the surfaces that are seen in a frame to objects; starts, merges and removes the tracks of objects.
#include "stages/contact/object_tracker.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

constexpr int kSpeck = 8;            // fewer points than this (about 1 cm^2) do not make an object
constexpr double kSamePlace = 0.05;  // an object without a model moves at most this far between two frames [m]
constexpr double kOpenPlace = 0.2;   // the same for the centre of the visible part of a table [m]
// A component belongs to an object if this fraction of its points lies on the model of the object.
constexpr double kOverlap = 0.4;
// An object has left its place if at least this fraction of its model's surface is seen to be empty space.
constexpr double kGone = 0.25;
// Two objects are the same one if this fraction of a component of one lies on the model of the other.
constexpr double kSame = 0.7;
// Times after which an object that is not seen any more is forgotten [us]: kForgottenHeld if it was held, or if a hand
// touches it, whose fingers may cover it; kForgotten otherwise.
constexpr std::int64_t kForgotten = 500'000, kForgottenHeld = 3'000'000;
constexpr double kLongest = 0.25;  // longest time between two frames from which a velocity is computed [s]

}  // namespace

void ObjectTracker::process(std::int64_t utime, const HandEstimates& estimates, const ObservedSpace& space,
                            const std::vector<bool>& open, std::vector<SurfacePoint>& points,
                            FrameVector<ObjectEstimate>& objects) {
  // Assign the points to the objects of earlier frames or to new ones.
  links_.link(open, points);
  all_.clear();
  for (const SurfacePoint& point : points) all_.push_back(&point);
  for (ObjectTrack& track : tracks_) track.predict(estimates, space, all_);
  match_models(utime, space, points);
  match_centres(utime, points);
  merge(utime);
  give_points(points);

  // Update the objects, and forget those that have not been seen for long.
  const double elapsed = 1e-6 * static_cast<double>(utime - last_);
  last_ = utime;
  for (ObjectTrack& track : tracks_) track.update(utime, std::abs(elapsed) < kLongest ? elapsed : 0, estimates, space);
  std::erase_if(tracks_, [&](const ObjectTrack& track) {
    return std::abs(utime - track.seen) > (track.state.held || track.touches > 0 ? kForgottenHeld : kForgotten);
  });

  std::ranges::sort(tracks_, {}, [](const ObjectTrack& track) { return track.state.id; });  // merge() renames tracks

  // Output the objects that are seen or held, and the hidden points of their models.
  for (const ObjectTrack& track : tracks_) {
    if (track.seen == utime || track.state.held) objects.push_back(track.state);
    if (!track.open) track.model.append_hidden(track.state.T_camera_object, space, track.state.id, points);
  }
}

void ObjectTracker::note_touches(std::span<const HandContacts> hands) {
  for (ObjectTrack& track : tracks_) {
    track.touches = 0;
    for (const HandContacts& hand : hands)
      for (const Contact& contact : hand.object)
        track.touches += contact.state == ContactState::touching && contact.partner == track.state.id;
  }
}

bool ObjectTracker::seen_empty(std::int32_t object, const Eigen::Vector3f& p) const {
  for (const ObjectTrack& track : tracks_)
    if (track.state.id == object)
      return track.modelled() &&
             track.model.seen_empty((track.state.T_camera_object.inverse() * p.cast<double>()).cast<float>());
  return false;
}

/// Assigns every component to the track on whose model most of its points lie. A component that continues out of view,
/// as a table does, is not assigned to the model of an object that stands on it, unless the component is a speck.
void ObjectTracker::match_models(std::int64_t utime, const ObservedSpace& space,
                                 const std::vector<SurfacePoint>& points) {
  // Count the points of each component on each model.
  const auto components = static_cast<std::size_t>(links_.components());
  count_.assign(components, 0);
  for (const SurfacePoint& point : points) ++count_[point.component];

  near_.assign(tracks_.size() * components, 0);
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (!tracks_[t].modelled()) continue;
    const Eigen::Matrix3f R = tracks_[t].predicted.R.transpose().cast<float>();
    const Eigen::Vector3f origin = tracks_[t].predicted.t.cast<float>();
    for (const SurfacePoint& point : points)
      near_[t * components + point.component] += tracks_[t].model.near(R * (point.p - origin));
  }

  // A component that continues out of view, such as a table, may contain an object that stands on it. The object counts
  // as seen if points of the component are near the object's model and the frame does not contradict the model.
  owner_.assign(components, -1);
  for (std::size_t i = 0; i < components; ++i) {
    if (links_.open(static_cast<std::int32_t>(i)) && count_[i] >= kSpeck) {
      for (std::size_t t = 0; t < tracks_.size(); ++t) {
        ObjectTrack& track = tracks_[t];
        if (track.seen == utime || near_[t * components + i] < kSpeck) continue;
        if (track.model.contradiction(track.predicted, {}, space) < kGone) track.seen = utime;
      }
      continue;
    }

    // Assign the component to the track whose model has most of its points near, if they are enough.
    int most = std::max(0, static_cast<int>(kOverlap * count_[i]) - 1);
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      if (near_[t * components + i] <= most) continue;
      most = near_[t * components + i];
      owner_[i] = static_cast<int>(t);
    }

    if (owner_[i] < 0) continue;
    tracks_[owner_[i]].seen = utime;
    tracks_[owner_[i]].placed = true;
  }
}

/// Assigns every cluster of linked components that lie on no model to the nearest track, or to a new one.
void ObjectTracker::match_centres(std::int64_t utime, const std::vector<SurfacePoint>& points) {
  // Add up the points of each cluster, and find the clusters that continue out of view.
  clusters_.assign(static_cast<std::size_t>(links_.components()), {});
  for (std::int32_t i = 0; i < links_.components(); ++i)
    if (links_.open(i)) clusters_[links_.root(i)].open = true;
  for (const SurfacePoint& point : points) {
    if (owner_[point.component] >= 0) continue;
    Cluster& cluster = clusters_[links_.root(point.component)];
    cluster.sum += point.p.cast<double>();
    ++cluster.count;
  }

  // Assign clusters to tracks that were not seen yet in this frame, beginning with the nearest pair.
  const std::size_t known = tracks_.size();
  while (true) {
    // Find the nearest pair of an unassigned cluster and a track that was not seen yet.
    Cluster* best = nullptr;
    std::size_t best_track = 0;
    double least = 1;

    // Compare all pairs by their distance relative to the largest allowed one.
    for (Cluster& cluster : clusters_) {
      if (cluster.count < kSpeck || cluster.track >= 0) continue;
      for (std::size_t t = 0; t < known; ++t) {
        if (tracks_[t].seen == utime || tracks_[t].open != cluster.open) continue;
        const double distance =
            (cluster.centre() - tracks_[t].centre).norm() / (cluster.open ? kOpenPlace : kSamePlace);
        if (distance < least) best = &cluster, best_track = t, least = distance;
      }
    }

    // Join this pair, or stop if none is near enough.
    if (!best) break;
    best->track = static_cast<int>(best_track);
    tracks_[best_track].seen = utime;
  }

  // Start new tracks.
  for (Cluster& cluster : clusters_) {
    if (cluster.count < kSpeck || cluster.track >= 0) continue;
    cluster.track = static_cast<int>(tracks_.size());
    ObjectTrack& track = tracks_.emplace_back();
    track.state.id = next_id_++;
    track.seen = track.state.since = utime;
    track.open = cluster.open;
  }
}

/// Removes each track that was not seen and on whose model points of another track lie: both are the same object, which
/// keeps the older id.
void ObjectTracker::merge(std::int64_t utime) {
  const auto components = static_cast<std::size_t>(links_.components());
  const std::size_t known = components == 0 ? 0 : near_.size() / components;

  // For each track that was not seen, look for another track whose points lie on its model.
  for (std::size_t t = 0; t < known; ++t) {
    ObjectTrack& track = tracks_[t];
    for (std::size_t i = 0; i < components && track.seen != utime; ++i) {
      if (owner_[i] < 0 || count_[i] < kSpeck || near_[t * components + i] < kSame * count_[i]) continue;

      // Keep the older identifier and forget the model of the track that was not seen.
      ObjectTrack& other = tracks_[owner_[i]];
      if (track.state.id < other.state.id) other.rename(track.state.id);
      track = ObjectTrack();
      track.state.id = -1;
      track.seen = utime - kForgotten - 1;
      break;
    }
  }
}

/// Stores the object of each point, and the points of each track. Removes points that belong to no object.
void ObjectTracker::give_points(std::vector<SurfacePoint>& points) {
  for (SurfacePoint& point : points) {
    const int owner = owner_[point.component], t = owner >= 0 ? owner : clusters_[links_.root(point.component)].track;
    point.object = t < 0 ? -1 : tracks_[t].state.id;
  }
  std::erase_if(points, [](const SurfacePoint& point) { return point.object < 0; });
  for (const SurfacePoint& point : points)
    for (ObjectTrack& track : tracks_)
      if (track.state.id == point.object) track.points.push_back(&point);
}

}  // namespace barehand
