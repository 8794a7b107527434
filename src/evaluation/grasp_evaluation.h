#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "evaluation/reliability.h"
#include "hand/grasps/frame_grasps.h"

namespace barehand {

// Compares the grasps that the tracker reported ("stated" grasps) with the true ones.

/// A stated class counts as confident if its probability is at least this.
inline constexpr double kConfidentGrasp = 0.9;
/// Frames without a grasp that are closer to a grasp than this time are not compared, since the hand is closing or
/// opening [us].
inline constexpr std::int64_t kClosingUs = 600'000;

/// The true grasp of each frame, by the frame's time [us]. 0 means no grasp; otherwise, it is 1 + the index in
/// grasp_types().
using GraspTruth = std::map<std::int64_t, int>;
/// Reads a table of grasps (docs/formats.md). Errors name the line: an unknown class, a malformed number.
Result<GraspTruth> read_grasp_truth(const std::string& path);

/// The grasp that a log of hand states contains for one frame.
struct StatedGrasp {
  bool known = false;  ///< false: the log states UNKNOWN
  int grasp = 0;       ///< class, numbered as in GraspTruth
  double probability = 0;
  GraspKind kind = GraspKind::none;
};
/// The stated grasps by the time of their frames [us].
using StatedGrasps = std::map<std::int64_t, StatedGrasp>;

/// Counts what was stated in the frames of one true class.
struct GraspCounts {
  std::size_t frames = 0, unknown = 0;
  std::size_t right = 0;       ///< the class is right
  std::size_t right_kind = 0;  ///< the kind (power, intermediate, precision) is right
  std::size_t confident_wrong = 0;
  std::array<std::size_t, kGraspCount> stated{};  ///< number of frames for each stated class

  double fraction(std::size_t part) const {
    return frames == 0 ? 0 : static_cast<double>(part) / static_cast<double>(frames);
  }
};

/// Result of comparing stated with true grasps. Frames in which nothing is stated count as wrong, but not as confident.
struct GraspEvaluation {
  std::array<GraspCounts, kGraspCount> classes;  ///< counts for each true class
  GraspCounts held;                              ///< all frames with a grasp
  double held_seconds = 0;
  std::size_t changes = 0;                    ///< number of changes of the stated class while the same grasp lasts
  std::vector<ReliabilityBin> probabilities;  ///< mean stated probability, and fraction of frames with the right class

  double changes_per_second() const { return held_seconds > 0 ? static_cast<double>(changes) / held_seconds : 0; }
};

/// The truth and the statements of one sequence.
struct GraspSequence {
  GraspTruth truth;
  StatedGrasps stated;
};
/// Evaluates several sequences in the frames whose true grasps are known. Error: the two tables of a sequence have no
/// frame in common.
Result<GraspEvaluation> evaluate_grasps(const std::vector<GraspSequence>& sequences);

}  // namespace barehand
