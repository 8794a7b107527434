#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "io/result_table.h"

namespace barehand {

/// Where an estimate put one segment, and how sure it said to be. Camera frame, metres.
struct StatedSegment {
  Eigen::Vector3d proximal, distal;
  Eigen::Matrix3d proximal_covariance, distal_covariance;  ///< of the two ends [m^2]
  double confidence = 0;                                   ///< SegmentState::confidence
  bool seen = false;                                       ///< estimated from data, or inferred
};
/// By frame number.
using StatedPoses = std::map<std::int64_t, std::array<StatedSegment, kSegmentCount>>;

/// How often the truth lies where a 90 % interval along one camera axis says.
struct Coverage {
  std::size_t intervals = 0;  ///< three of each end of each segment
  double covered = 0;         ///< fraction of them
  double stated = 0;          ///< root mean square of the stated error of an end [m]
  double actual = 0;          ///< of its actual error [m]
};

/// Said against found, for everything whose statement falls into one bin.
struct ReliabilityBin {
  std::size_t count = 0;
  double stated = 0, actual = 0;
};

/// Whether estimates know how far they are off.
struct Reliability {
  std::size_t frames = 0;
  Coverage all, seen, inferred;
  std::vector<ReliabilityBin> errors;       ///< root mean squares of errors of an end [m], by the stated one
  std::vector<ReliabilityBin> confidences;  ///< mean confidence; fraction with both ends within kConfidenceRadius
};

/// Of several sequences, each truth with its statements: over the frames that both have. Error: there is none.
Result<Reliability> judge_reliability(const std::vector<std::pair<ResultTable, StatedPoses>>& sequences);

}  // namespace barehand
