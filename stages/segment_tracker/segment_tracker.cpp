#include "stages/segment_tracker/segment_tracker.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "math/schedule.h"
#include "stages/segment_tracker/self_occlusion.h"

namespace barehand {
namespace {

constexpr int kChunk = 16;  // samples per task: small enough to balance, large enough to be worth a task

void copy_labels(const Image<std::uint16_t>& hidden, PixelMap& map) {
  assert(hidden.width() + 2 == map.width && hidden.height() + 2 == map.height);
  for (int v = 0; v < hidden.height(); ++v)
    for (int u = 0; u < hidden.width(); ++u) map.hidden[map.index(u + 1, v + 1)] = hidden.at(u, v);
}

/// Eq. 3. A sample without evidence gets the mean distance of its siblings: neither punished nor preferred.
std::vector<double> log_likelihood(const std::vector<double>& mean_distance, const std::vector<char>& has_evidence,
                                   double alpha, double sigma_obs) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < mean_distance.size(); ++i) {
    if (!has_evidence[i]) continue;
    sum += mean_distance[i];
    ++count;
  }
  const double neutral = count > 0 ? sum / count : 0;
  std::vector<double> log_l(mean_distance.size());
  for (std::size_t i = 0; i < log_l.size(); ++i) {
    const double d = (has_evidence[i] ? mean_distance[i] : neutral) / sigma_obs;
    log_l[i] = -alpha * d * d;
  }
  return log_l;
}

}  // namespace

SegmentTracker::SegmentTracker(const SegmentTrackerParams& params, std::shared_ptr<const HandSurface> surface,
                               Workers& workers)
    : params_(params), surface_(std::move(surface)), workers_(workers) {}

PatchDistance SegmentTracker::compare(const PreparedObservation& prepared, int segment,
                                      const SE3& T_camera_segment) const {
  const float cap = params_.pixel_distance_cap > 0 ? static_cast<float>(params_.pixel_distance_cap)
                                                   : std::numeric_limits<float>::infinity();
  return patch_distance((*surface_)[segment], T_camera_segment, segment, prepared.map, cap);
}

PreparedObservation SegmentTracker::prepare(const HandObservation& observation, const HandPose& predicted,
                                            const Image<std::uint16_t>* hidden) const {
  PreparedObservation prepared;
  prepared.map = make_pixel_map(observation, params_.missing_depth == "background", workers_);
  if (hidden)
    copy_labels(*hidden, prepared.map);
  else
    label_self_occlusion(*surface_, predicted, params_, prepared.map, workers_);
  for (int s = 0; s < kSegmentCount; ++s)
    prepared.unoccluded[s] = compare(prepared, s, predicted[s]).counted_fraction();
  return prepared;
}

SegmentSamples SegmentTracker::sample(const PreparedObservation& prepared, const Proposals& proposals,
                                      const SampleKey& key) const {
  const int count = params_.samples, chunks = (count + kChunk - 1) / kChunk;
  SegmentSamples samples;
  std::array<std::vector<double>, kSegmentCount> distance;
  std::array<std::vector<char>, kSegmentCount> has_evidence;
  for (int s = 0; s < kSegmentCount; ++s) {
    samples.poses[s].resize(count);
    distance[s].assign(count, 0.0);
    has_evidence[s].assign(count, 0);
  }
  workers_.for_each_index(kSegmentCount * chunks, [&](int task) {
    const int s = task / chunks, begin = task % chunks * kChunk, end = std::min(begin + kChunk, count);
    for (int i = begin; i < end; ++i) {
      samples.poses[s][i] = draw_sample(proposals[s], s, i, key);
      if (!observed(s)) continue;
      const PatchDistance patch = compare(prepared, s, samples.poses[s][i]);
      distance[s][i] = patch.mean();
      has_evidence[s][i] = patch.counted > 0 && patch.counted_fraction() >= params_.min_counted;
    }
  });
  const double sigma_obs = geometric(params_.sigma_obs_start, params_.sigma_obs_end, key.level, key.levels);
  samples.unoccluded = prepared.unoccluded;
  for (int s = 0; s < kSegmentCount; ++s)
    samples.log_likelihood[s] = log_likelihood(distance[s], has_evidence[s], prepared.unoccluded[s], sigma_obs);
  return samples;
}

}  // namespace barehand
