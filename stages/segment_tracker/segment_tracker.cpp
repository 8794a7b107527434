// Draws samples of all segments and computes their likelihoods (paper, Sec. 4).
#include "stages/segment_tracker/segment_tracker.h"

#include <algorithm>

#include "math/schedule.h"
#include "stages/segment_tracker/cpu_observer.h"
#include "stages/segment_tracker/patch_distance.h"

namespace barehand {
namespace {

/// Computes log L of the paper's Eq. 3 for all samples of a segment. A sample without evidence gets the mean distance
/// of the others, so that it is neither penalised nor preferred.
void log_likelihood(const std::vector<PatchDistance>& patches, double min_counted, double alpha, double sigma_obs,
                    std::vector<double>& log_l) {
  const auto has_evidence = [&](const PatchDistance& p) {
    return p.counted > 0 && p.counted_fraction() >= min_counted;
  };

  // Compute the mean distance of the samples with evidence.
  double sum = 0;
  int count = 0;
  for (const PatchDistance& patch : patches) {
    if (!has_evidence(patch)) continue;
    sum += patch.mean();
    ++count;
  }
  const double neutral = count > 0 ? sum / count : 0;

  // Compute the log-likelihoods (paper, Eq. 3).
  log_l.resize(patches.size());
  for (std::size_t i = 0; i < log_l.size(); ++i) {
    const double d = (has_evidence(patches[i]) ? patches[i].mean() : neutral) / sigma_obs;
    log_l[i] = -alpha * d * d;
  }
}

}  // namespace

SegmentTracker::SegmentTracker(const SegmentTrackerParams& params, std::shared_ptr<const HandSurface> surface,
                               Workers& workers, std::shared_ptr<Observer> observer)
    : params_(params), surface_(std::move(surface)), workers_(workers), observer_(std::move(observer)) {
  if (!observer_) observer_ = std::make_unique<CpuObserver>(distance_cap(params_), workers_);
}

PatchDistance SegmentTracker::compare(const PreparedObservation& prepared, int segment,
                                      const SE3& T_camera_segment) const {
  return patch_distance((*surface_)[segment], T_camera_segment, segment, prepared.map, distance_cap(params_));
}

const PreparedObservation& SegmentTracker::prepare(const HandObservation& observation, const HandPose& predicted) {
  PixelMap& map = prepared_.map;
  ++prepared_.id;
  map = make_pixel_map(observation, params_.missing_depth == "background", workers_, std::move(map));
  self_occlusion_.label(*surface_, predicted, params_, map, workers_);
  for (int s = 0; s < kSegmentCount; ++s)
    prepared_.unoccluded[s] = compare(prepared_, s, predicted[s]).counted_fraction();
  return prepared_;
}

const SegmentSamples& SegmentTracker::sample(const PreparedObservation& prepared, const Proposals& proposals,
                                             const SampleKey& key, int count) {
  // Draw the samples.
  const int chunks = (count + kSampleChunk - 1) / kSampleChunk;
  for (auto& poses : samples_.poses) poses.resize(count);
  workers_.for_each_index(kSegmentCount * chunks, [&](int task) {
    const int s = task / chunks, begin = task % chunks * kSampleChunk, end = std::min(begin + kSampleChunk, count);
    for (int i = begin; i < end; ++i) samples_.poses[s][i] = draw_sample(proposals[s], s, i, key);
  });

  // Compare the samples with the data, without the palm if the settings say that it is not observed.
  observer_->compare({surface_, prepared.map, prepared.id, samples_.poses, first_compared(params_)}, distances_);

  // Compute the likelihoods; sigma shrinks from level to level.
  const double sigma_obs = geometric(params_.sigma_obs_start, params_.sigma_obs_end, key.level, key.levels);
  samples_.unoccluded = prepared.unoccluded;
  for (int s = 0; s < kSegmentCount; ++s)
    log_likelihood(distances_[s], params_.min_counted, prepared.unoccluded[s], sigma_obs, samples_.log_likelihood[s]);
  return samples_;
}

}  // namespace barehand
