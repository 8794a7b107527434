#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "io/hand/result_table.h"

namespace barehand {

/// The pose of one segment as an estimate states it, with its uncertainty. Camera frame, metres.
struct StatedSegment {
  Eigen::Vector3d proximal, distal;
  Eigen::Matrix3d proximal_covariance, distal_covariance;  ///< of the two ends [m^2]
  double confidence = 0;                                   ///< SegmentState::confidence
  bool seen = false;                                       ///< estimated from data; false: inferred
};
/// The stated poses of all segments, by frame number.
using StatedPoses = std::map<std::int64_t, std::array<StatedSegment, kSegmentCount>>;

/// How often the truth lies within the stated 90 % interval along one axis of the camera.
struct Coverage {
  std::size_t intervals = 0;  ///< three for each end of each segment
  double covered = 0;         ///< fraction of the intervals that contain the truth
  double stated = 0;          ///< root mean square of the stated errors of an end [m]
  double actual = 0;          ///< root mean square of its actual errors [m]
};

/// Stated against actual values of everything whose stated value falls into one bin.
struct ReliabilityBin {
  std::size_t count = 0;
  double stated = 0, actual = 0;
};

/// How well the stated uncertainty of estimates agrees with their actual errors.
struct Reliability {
  std::size_t frames = 0;
  Coverage all, seen, inferred;
  std::vector<ReliabilityBin> errors;  ///< root mean square errors of an end [m], binned by the stated error
  /// Mean confidence, and fraction of segments with both ends within kConfidenceRadius.
  std::vector<ReliabilityBin> confidences;
};

/// Evaluates several sequences, each the truth and the stated poses, over the frames that both contain. Error: there
/// is no such frame.
Result<Reliability> judge_reliability(const std::vector<std::pair<ResultTable, StatedPoses>>& sequences);

}  // namespace barehand
