#pragma once

#include <array>
#include <memory>

#include "core/parallel/parallel.h"
#include "hand/hand_pose.h"
#include "hand/samples.h"
#include "stages/fusion/fusion_params.h"
#include "stages/fusion/joint_energy.h"
#include "stages/fusion/mode.h"

namespace barehand {

// Belief propagation over the hand's tree: combines the samples of all segments, level by level, into one pose.

/// The final estimate of one frame, read from the belief of the last level.
struct FusedPose {
  HandPose pose;                                   ///< neighbouring segments need not meet exactly (paper, Sec. 3.1)
  std::array<Matrix6d, kSegmentCount> covariance;  ///< second moment of the belief about `pose`; boxplus, camera frame
};

/// Combines the local trackers through the structure of the hand (paper Sec. 4.3) and narrows the search from level to
/// level, coarse to fine (Sec. 4.4). Results depend on the arguments only. A returned reference is valid until the same
/// function is called again, because its memory is reused. Every segment of `samples` needs at least one sample.
class Fusion {
 public:
  /// `workers` must outlive this object.
  Fusion(const FusionParams& params, std::shared_ptr<const HandProfile> profile, Workers& workers);

  const FusionParams& params() const { return params_; }

  /// The proposals of level 0 (first, coarsest level): one box per segment around the prediction. `interval_factor`
  /// scales all search ranges of the frame: the time since the last frame relative to the nominal interval (2 after a
  /// dropped frame).
  const Proposals& first_proposals(const HandPose& predicted, double interval_factor = 1);
  /// Marginal posterior of every segment over its samples, exact on the tree (paper, Eq. 4-8). Levels count from 0.
  const HandBelief& fuse(const SegmentSamples& samples, int level);
  /// Memory that fuse() needs for this number of samples per segment: the energies of all pairs of samples at the 15
  /// joints [bytes].
  static std::int64_t memory(std::int64_t samples);
  /// The proposals of level + 1: boxes around the best distinct samples of `level`, best first, at most S' of them.
  const Proposals& next_proposals(const SegmentSamples& samples, const HandBelief& belief, int level,
                                  double interval_factor = 1);
  /// Pose and covariance after the last level. The covariance is that of all samples under the belief, plus the
  /// variance of the box between two samples of the last level, since sampling cannot be more accurate than the
  /// spacing of the samples.
  FusedPose read_out(const SegmentSamples& samples, const HandBelief& belief, double interval_factor = 1) const;

 private:
  // Half widths of a segment's box at a level: translation [m], rotation [rad].
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
