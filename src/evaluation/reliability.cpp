#include "evaluation/reliability.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

// Compares stated covariances and confidences with actual errors.

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNinetyPercent = 1.6449;  // half width of a 90 % interval, in standard deviations
// Lower bound of the first bin [m], and ratio of the bounds of each bin (half an octave).
constexpr double kFirstErrorBin = 0.0005, kErrorBinRatio = 1.41421356;
constexpr int kErrorBins = 14;

/// Accumulates the coverage (see Coverage) of one group of segments.
class CoverageSum {
 public:
  void add(const Vector3d& error, const Matrix3d& covariance) {
    for (int axis = 0; axis < 3; ++axis)
      covered_ += std::abs(error[axis]) <= kNinetyPercent * std::sqrt(covariance(axis, axis));
    stated_ += covariance.trace();
    actual_ += error.squaredNorm();
    ++ends_;
  }
  Coverage result() const {
    if (ends_ == 0) return {};
    return {3 * ends_, static_cast<double>(covered_) / (3 * ends_), std::sqrt(stated_ / ends_),
            std::sqrt(actual_ / ends_)};
  }

 private:
  std::size_t ends_ = 0, covered_ = 0;
  double stated_ = 0, actual_ = 0;
};

/// Accumulates the statistics of all sequences.
class ReliabilitySums {
 public:
  void add(const TableRow& truth, const StatedSegment& stated) {
    const Vector3d proximal = stated.proximal - truth.proximal, distal = stated.distal - truth.distal;
    add(proximal, stated.proximal_covariance, stated.seen);
    add(distal, stated.distal_covariance, stated.seen);
    confidences_.add(stated.confidence, std::max(proximal.norm(), distal.norm()) <= kConfidenceRadius);
  }
  void add_frame() { ++frames_; }

  Reliability result() const {
    Reliability out{frames_, all_.result(), seen_.result(), inferred_.result(), {}, confidences_.means()};
    for (const ReliabilityBin& bin : errors_)
      if (bin.count > 0)
        out.errors.push_back({bin.count, std::sqrt(bin.stated / bin.count), std::sqrt(bin.actual / bin.count)});
    return out;
  }

 private:
  // Adds the error of one end.
  void add(const Vector3d& error, const Matrix3d& covariance, bool seen) {
    all_.add(error, covariance);
    (seen ? seen_ : inferred_).add(error, covariance);
    const double octaves = std::log(std::sqrt(covariance.trace()) / kFirstErrorBin) / std::log(kErrorBinRatio);
    ReliabilityBin& bin = errors_[static_cast<int>(std::clamp(octaves, 0.0, kErrorBins - 1.0))];
    ++bin.count;
    bin.stated += covariance.trace();
    bin.actual += error.squaredNorm();
  }

  std::size_t frames_ = 0;
  CoverageSum all_, seen_, inferred_;
  std::array<ReliabilityBin, kErrorBins> errors_{};
  ProbabilityBins confidences_;
};

}  // namespace

void ProbabilityBins::add(double stated, bool happened) {
  const int count = static_cast<int>(sums_.size());
  ReliabilityBin& bin = sums_[std::clamp(static_cast<int>(stated * count), 0, count - 1)];
  ++bin.count;
  bin.stated += stated;
  bin.actual += happened;
}

std::vector<ReliabilityBin> ProbabilityBins::means() const {
  std::vector<ReliabilityBin> means;
  for (const ReliabilityBin& bin : sums_)
    if (bin.count > 0) means.push_back({bin.count, bin.stated / bin.count, bin.actual / bin.count});
  return means;
}

Result<Reliability> evaluate_reliability(const std::vector<std::pair<ResultTable, StatedPoses>>& sequences) {
  // Add up the frames that both tables contain.
  ReliabilitySums sums;
  for (const auto& [truth, stated] : sequences)
    for (const TableFrame& frame : truth.frames) {
      const auto said = stated.find(frame.number);
      if (said == stated.end()) continue;
      if (!same_time(frame.timestamp, said->second.utime * 1e-6))
        return fail("frame " + std::to_string(frame.number) + " has other time stamps in truth and states", {},
                    "give the truth of the same recording");
      sums.add_frame();
      for (int s = 0; s < kSegmentCount; ++s) sums.add(frame.rows[s], said->second.segments[s]);
    }

  // Report an error if no frame has a pose in both tables.
  Reliability result = sums.result();
  if (result.frames == 0)
    return fail("have no frame with a pose in common with the truth", "the states",
                "give the truth of the same recording");
  return result;
}

}  // namespace barehand
