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

// Compares stated grasps with the truth.

/// A probability from which a statement is confident.
inline constexpr double kConfidentGrasp = 0.9;
/// Time before and after a grasp in which a hand that holds nothing is closing or opening, and is not compared [us].
inline constexpr std::int64_t kClosingUs = 600'000;

/// The grasp in each frame, by its time [us]: 0: none, otherwise 1 + the index in grasp_types().
using GraspTruth = std::map<std::int64_t, int>;
/// Reads a table of grasps (docs/formats.md). Errors name the line: an unknown class, a malformed number.
Result<GraspTruth> read_grasp_truth(const std::string& path);

/// The grasp that a log of hand states contains for one frame.
struct StatedGrasp {
  bool known = false;  ///< false: the classes are UNKNOWN
  int grasp = 0;       ///< class, numbered as in GraspTruth
  double probability = 0;
  GraspKind kind = GraspKind::none;
};
/// The stated grasps by the time of their frames [us].
using StatedGrasps = std::map<std::int64_t, StatedGrasp>;

/// How the frames of one true class were stated.
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

/// Stated against true grasps. Frames in which nothing is stated count as wrong, but not as confident.
struct GraspEvaluation {
  std::array<GraspCounts, kGraspCount> classes;  ///< counts for each true class
  GraspCounts held;                              ///< all frames with a grasp
  double held_seconds = 0;
  std::size_t changes = 0;                    ///< number of changes of the stated class while the same grasp lasts
  std::vector<ReliabilityBin> probabilities;  ///< stated probability of the class against the fraction that is right

  double changes_per_second() const { return held_seconds > 0 ? static_cast<double>(changes) / held_seconds : 0; }
};

/// The truth and the statements of one sequence.
struct GraspSequence {
  GraspTruth truth;
  StatedGrasps stated;
};
/// Evaluates several sequences over the frames of their truths. Error: the tables of a sequence have no frame in
/// common.
Result<GraspEvaluation> evaluate_grasps(const std::vector<GraspSequence>& sequences);

}  // namespace barehand
