#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "io/hand/result_table.h"

namespace barehand {

// Checks how well the stated uncertainties of a result agree with its actual errors.

/// The pose of one segment in an estimate, with the stated uncertainty. Camera frame, metres.
struct StatedSegment {
  Eigen::Vector3d proximal, distal;
  Eigen::Matrix3d proximal_covariance, distal_covariance;  ///< stated covariances of the two ends [m^2]
  double confidence = 0;                                   ///< SegmentState::confidence
  bool seen = false;                                       ///< estimated from data; false: inferred
};
/// The stated pose of a hand in one frame.
struct StatedPose {
  std::int64_t utime = 0;  ///< time stamp of the frame [us]
  std::array<StatedSegment, kSegmentCount> segments;
};
/// The stated poses, by frame number.
using StatedPoses = std::map<std::int64_t, StatedPose>;

/// Agreement of the stated covariances of segment ends with their actual errors. The covariance of an end yields a 90 %
/// interval along each of the three axes of the camera frame.
struct Coverage {
  std::size_t intervals = 0;  ///< number of intervals, three for each end of each segment
  double covered = 0;         ///< fraction of the intervals that contain the truth
  double stated = 0;          ///< root mean square error of an end according to the covariances [m]
  double actual = 0;          ///< actual root mean square error of an end [m]
};

/// Average stated and actual value of all samples whose stated value falls into one bin.
struct ReliabilityBin {
  std::size_t count = 0;
  double stated = 0, actual = 0;
};

/// Collects stated probabilities in ten bins of equal width.
class ProbabilityBins {
 public:
  /// `happened`: whether what was stated with this probability (in [0, 1]) is true.
  void add(double stated, bool happened);
  /// Of each bin that is not empty, the mean stated probability, and the fraction that happened.
  std::vector<ReliabilityBin> means() const;

 private:
  std::array<ReliabilityBin, 10> sums_{};
};

/// How well the stated uncertainty of estimates agrees with their actual errors.
struct Reliability {
  std::size_t frames = 0;
  Coverage all, seen, inferred;
  std::vector<ReliabilityBin> errors;  ///< root mean square errors of an end [m], binned by the stated error
  /// Mean confidence, and fraction of segments with both ends within kConfidenceRadius.
  std::vector<ReliabilityBin> confidences;
};

/// Evaluates several sequences, each given by the truth and the stated poses, over the frames that both contain.
/// Errors: there is no such frame; one has other time stamps in the two.
Result<Reliability> evaluate_reliability(const std::vector<std::pair<ResultTable, StatedPoses>>& sequences);

}  // namespace barehand
