#pragma once

#include <array>
#include <memory>

#include "core/parallel.h"
#include "hand/hand_pose.h"
#include "hand/samples.h"
#include "stages/fusion/fusion_params.h"
#include "stages/fusion/joint_energy.h"
#include "stages/fusion/mode.h"

namespace barehand {

/// Final estimate of one frame from the last level's belief.
struct FusedPose {
  HandPose pose;                                   ///< segments need not touch exactly (Sec. 3.1)
  std::array<Matrix6d, kSegmentCount> covariance;  ///< of the belief around `pose`, boxplus twist, camera frame
};

/// Combines the local trackers through the hand's structure (paper Sec. 4.3) and narrows the search level by level
/// (Sec. 4.4). Results depend on the arguments alone, and those that are references are valid until the same kind of
/// result is asked for again: their memory is kept. Every segment of `samples` needs at least one sample.
class Fusion {
 public:
  Fusion(const FusionParams& params, std::shared_ptr<const HandProfile> profile, Workers& workers);

  const FusionParams& params() const { return params_; }

  /// One box per segment around the prediction: the proposals of level 0. `interval_factor` scales every range of the
  /// frame: time since the last frame over the nominal interval (a dropped frame doubles it).
  const Proposals& first_proposals(const HandPose& predicted, double interval_factor = 1);
  /// Marginal posterior of every segment over its samples, exact on the tree (Eq. 4-8). `level` from 0.
  const HandBelief& fuse(const SegmentSamples& samples, int level);
  /// Bytes that fuse holds for `samples` per segment: the energies of all pairs along the 15 joints.
  static std::int64_t memory(std::int64_t samples);
  /// The S' best distinct samples of `level` as boxes of level + 1, best first; fewer where they are not distinct.
  const Proposals& next_proposals(const SegmentSamples& samples, const HandBelief& belief, int level,
                                  double interval_factor = 1);
  /// Pose and covariance from the last level. The covariance is that of all samples under the belief, plus the
  /// variance of the last level's box between two samples: sampling cannot know better than its own spacing.
  FusedPose read_out(const SegmentSamples& samples, const HandBelief& belief, double interval_factor = 1) const;

 private:
  Vector6d half_width(int segment, int level, double interval_factor) const;

  FusionParams params_;
  JointModels joints_;
  Workers& workers_;
  BeliefPropagation propagation_;
  DistinctChoice choice_;
  std::array<ParentFrames, kSegmentCount> frames_;
  std::array<EdgeEnergy, kSegmentCount> energy_;
  HandBelief belief_;
  Proposals proposals_;
};

}  // namespace barehand
