#include "stages/known_object/object_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/angles.h"
#include "stages/known_object/object_fit.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kOrientations = 500;          // about 20 degrees apart
constexpr std::size_t kFewPoints = 80;      // number of points and samples with which orientations are compared
constexpr std::size_t kLeastPoints = 25;    // least number of points around a place that is searched
constexpr int kShifts = 4;                  // steps by which an orientation is moved into place
constexpr std::size_t kComparedPoses = 60;  // orientations that are compared with free space
constexpr std::size_t kRefined = 12;        // of these, those that are refined
constexpr int kFewIterations = 6, kSearchIterations = 12;
constexpr double kScale = 0.008;  // errors larger than this count as outliers [m]
constexpr double kOnSurface = 0.006, kSearchReach = 0.015;
constexpr std::size_t kSamples = 300;
constexpr double kLeastShownAtStart = 0.2, kMaxInconsistent = 0.1, kLeastExplained = 0.65;
constexpr double kMostContinuedAtStart = 0.15;  // of the outline; more is a part of something larger
constexpr int kLeastSeen = 15;
// What a refinement takes, and a whole search at most, if trying an orientation takes 1.
constexpr int kWorkOfRefinement = 16, kWork = kOrientations + 45 * kWorkOfRefinement;
// Two poses are the same if they are turned by less than kSmallTurn from each other, or if less than kFewMoved of the
// surface moves by more than kMoved [m].
constexpr double kSmallTurn = 20 * kDegree, kMoved = 0.004, kFewMoved = 0.02;

/// Orientations that cover all rotations evenly (super-Fibonacci spirals, Alexa 2022).
std::vector<Eigen::Matrix3d> spiral(int count) {
  constexpr double kPsi = 1.533751168755204288118041;
  std::vector<Eigen::Matrix3d> rotations;
  for (int i = 0; i < count; ++i) {
    const double s = i + 0.5, a = 2 * std::numbers::pi * s / std::numbers::sqrt2, b = 2 * std::numbers::pi * s / kPsi;
    const double r = std::sqrt(s / count), q = std::sqrt(1 - s / count);
    rotations.push_back(Eigen::Quaterniond(q * std::cos(b), r * std::sin(a), r * std::cos(a), q * std::sin(b))
                            .normalized()
                            .toRotationMatrix());
  }
  return rotations;
}

/// A weak prior. It keeps a pose from drifting in directions that the points do not constrain.
PosePrior anywhere_near(const SE3& T) {
  constexpr double kShift = 0.03, kTurn = 0.6;
  PosePrior prior{T};
  prior.information.diagonal() << Vector3d::Constant(1 / (kShift * kShift)), Vector3d::Constant(1 / (kTurn * kTurn));
  return prior;
}

double cost(const FoundPose& pose) { return pose.quality.cost(); }

}  // namespace

bool changes_little(const KnownObject& object, const SE3& T_object_object) {
  if (log_so3(T_object_object.R).norm() < kSmallTurn) return true;
  const auto samples = std::span(object.samples).first(std::min(kSamples, object.samples.size()));
  return moved_share(object.grid, samples, T_object_object, kMoved) < kFewMoved;
}

bool PoseQuality::acceptable() const {
  return visibility.shown() >= kLeastShownAtStart && visibility.seen >= kLeastSeen &&
         visibility.inconsistent() <= kMaxInconsistent && explained >= kLeastExplained;
}

PoseQuality quality_of(const KnownObject& object, const ObservedDepth& view, const SE3& T_camera_object,
                       std::span<const Vector3f> points) {
  PoseQuality quality;
  quality.visibility = view.visibility(object, T_camera_object, kSamples);

  // Count the points that could be the object, and those that are.
  const SE3 T_object_camera = T_camera_object.inverse();
  const Eigen::Matrix3f R = T_object_camera.R.cast<float>();
  const Vector3f t = T_object_camera.t.cast<float>(), centre = object.centre.cast<float>();
  const auto radius_sq = static_cast<float>(object.radius * object.radius);

  // Only points within the object's sphere could be the object.
  int within = 0, on_surface = 0;
  for (const Vector3f& point : points) {
    const Vector3f p = R * point + t;
    if ((p - centre).squaredNorm() > radius_sq) continue;
    ++within;
    on_surface += std::abs(object.grid.distance(p)) < kOnSurface;
  }

  quality.explained = on_surface / std::max(1.0, static_cast<double>(within));
  return quality;
}

ObjectSearch::ObjectSearch(KnownObjectPtr object) : object_(std::move(object)), orientations_(spiral(kOrientations)) {}

/// Moves an orientation so that the side that it shows lies over the middle of the points, and refines it on the few.
SE3 ObjectSearch::place(const Eigen::Matrix3d& R) const {
  const Vector3f view = (R.transpose() * middle_.normalized()).cast<float>();
  Vector3f shown = Vector3f::Zero();
  float count = 0;
  for (std::size_t i = 0; i < std::min(kFewPoints, object_->samples.size()); ++i)
    if (object_->samples[i].n.dot(view) < 0) shown += object_->samples[i].p, ++count;
  const SE3 start{R, middle_ - R * (shown / std::max(1.f, count)).cast<double>()};
  return fit_pose(*object_, few_, kScale / 3, start, anywhere_near(start), kFewIterations).T_camera_object;
}

/// How badly a pose fits the few points: between 0 and 1.
double ObjectSearch::misfit(const SE3& T) const {
  const SE3 T_object_camera = T.inverse();
  const Eigen::Matrix3f R = T_object_camera.R.cast<float>();
  const Vector3f t = T_object_camera.t.cast<float>();
  double sum = 0;
  for (const Vector3f& p : few_) {
    const double d = object_->grid.distance(R * p + t);
    sum += d * d / (kScale * kScale + d * d);
  }
  return sum / static_cast<double>(few_.size());
}

/// Collects the points that the object could cover if it were at the place, and moves the place to their middle.
Vector3f ObjectSearch::gather(Vector3f middle) {
  // Shift the middle to the mean of the points around it.
  const auto radius_sq = static_cast<float>(object_->radius * object_->radius);
  for (int i = 0; i < kShifts; ++i) {
    around_.clear();
    Vector3f sum = Vector3f::Zero();
    for (const Vector3f& p : points_) {
      if ((p - middle).squaredNorm() > radius_sq) continue;
      around_.push_back(p);
      sum += p;
    }

    // Shift the middle to the mean of these points.
    if (around_.empty()) break;
    middle = sum / static_cast<float>(around_.size());
  }

  // Choose a few of them.
  few_.clear();
  const std::size_t step = around_.size() / kFewPoints + 1;
  for (std::size_t i = 0; i < around_.size(); i += step) few_.push_back(around_[i]);
  return middle;
}

void ObjectSearch::begin(const ObservedDepth& view, std::span<const Vector3f> points, const Vector3f& seed) {
  view_.reset();
  points_.assign(points.begin(), points.end());
  middle_ = gather(seed).cast<double>();
  tried_.clear();
  starts_.clear();
  refined_ = 0;
  found_.clear();
  if (around_.size() >= kLeastPoints) view_ = view;
}

bool ObjectSearch::advance(double share) {
  if (!under_way()) return false;
  for (double work = share * kWork; work > 0;) {
    // Try the orientations, then refine the best ones, and what they might be mistaken for.
    if (starts_.empty()) {
      const SE3 T = place(orientations_[tried_.size()]);
      tried_.emplace_back(misfit(T), T);
      if (tried_.size() == orientations_.size()) choose_starts();
      work -= 1;
    } else {
      refine(starts_[refined_++]);
      if (refined_ == kRefined) add_turns();
      work -= kWorkOfRefinement;
    }
    if (refined_ < kRefined || refined_ < starts_.size()) continue;

    // Nothing is left to do.
    choose();
    stop();
    return true;
  }
  return false;
}

/// Chooses the orientations that are refined.
void ObjectSearch::choose_starts() {
  // Keep the better ones by their misfit alone.
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::nth_element(tried_.begin(), tried_.begin() + kComparedPoses, tried_.end(), less);
  tried_.resize(kComparedPoses);

  // Of these, keep the best ones with the view compared as well: the camera must not see through them.
  for (auto& [cost, T] : tried_) cost += view_->visibility(*object_, T, kFewPoints).inconsistent();
  std::partial_sort(tried_.begin(), tried_.begin() + kRefined, tried_.end(), less);
  for (std::size_t i = 0; i < kRefined; ++i) starts_.push_back(tried_[i].second);
}

/// Refines a pose, and appends it to found_ if it is visible and consistent and explains the points.
void ObjectSearch::refine(const SE3& start) {
  near_.assign(few_.begin(), few_.end());
  view_->points_near(*object_, start, kSearchReach, 4 * kFewPoints, near_);
  const SE3 T = fit_pose(*object_, near_, kScale / 3, start, anywhere_near(start), kSearchIterations).T_camera_object;
  const FoundPose pose{T, quality_of(*object_, *view_, T, points_)};
  if (pose.quality.acceptable() && view_->continued(*object_, T) <= kMostContinuedAtStart) found_.push_back(pose);
}

/// The best pose may be wrong by a turn that changes little of what shows.
void ObjectSearch::add_turns() {
  if (found_.empty()) return;
  const SE3 best = std::ranges::min_element(found_, {}, cost)->T_camera_object;
  for (const SE3& turn : object_->turns) starts_.push_back(best * turn);
}

/// Sorts what was found, and leaves out what is almost the same as a better one.
void ObjectSearch::choose() {
  std::ranges::sort(found_, {}, cost);
  std::size_t kept = 0;
  for (const FoundPose& pose : found_) {
    const auto same = [&](const FoundPose& better) {
      return changes_little(*object_, better.T_camera_object.inverse() * pose.T_camera_object);
    };
    if (kept < kMostPoses && std::none_of(found_.begin(), found_.begin() + kept, same)) found_[kept++] = pose;
  }
  found_.resize(kept);
}

}  // namespace barehand
