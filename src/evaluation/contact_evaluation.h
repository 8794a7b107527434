#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "evaluation/reliability.h"
#include "hand/segments.h"
#include "io/hand/result_table.h"

namespace barehand {

// Compares stated contacts between hand and object with the truth.

/// Skin at most this far from an object touches it [m].
inline constexpr double kTouchDistance = 0.005;

/// A touch that is stated farther than this from the object's nearest place is a touch of something else [m].
inline constexpr double kSameSurface = 0.02;

/// How near one segment is to the object.
struct TrueContact {
  double distance = 0;    ///< signed, of the segment's skin [m]
  Eigen::Vector3d point;  ///< the nearest place of the object, camera frame [m]
};
/// The true contacts by the time of their frames [us].
using ContactTruth = std::map<std::int64_t, std::array<TrueContact, kSegmentCount>>;
/// Reads a contact table (docs/formats.md). Errors name the line: an unknown segment, a malformed number.
Result<ContactTruth> read_contact_truth(const std::string& path);

/// What a result states about one segment.
struct StatedContact {
  bool known = false;                               ///< false: the state is UNKNOWN
  bool touching = false;                            ///< the state is TOUCHING
  double probability = 0;                           ///< probability of a touch; meaningless unless known
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< point on the touched surface, camera frame [m]
};
/// The stated contacts by the time of their frames [us].
using StatedContacts = std::map<std::int64_t, std::array<StatedContact, kSegmentCount>>;

/// How often touches were stated correctly. A segment of unknown state counts as one of which no touch is stated, and
/// so does one that touches something else.
struct TouchCounts {
  std::size_t right = 0;    ///< touches that were stated
  std::size_t wrong = 0;    ///< stated touches that are not true
  std::size_t missed = 0;   ///< touches that were not stated
  std::size_t none = 0;     ///< neither
  std::size_t unknown = 0;  ///< segments of unknown state; part of `missed` and `none`

  double precision() const { return ratio(right, right + wrong); }
  double recall() const { return ratio(right, right + missed); }
  double f1() const { return ratio(2 * right, 2 * right + wrong + missed); }

 private:
  static double ratio(std::size_t part, std::size_t all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
  }
};

/// Stated against true contacts.
struct ContactEvaluation {
  std::size_t frames = 0;
  /// Fingertips by their visible fraction in truth: above 0.5, between, below 0.1; and all segments.
  TouchCounts visible_tips, partial_tips, hidden_tips, segments;
  std::vector<ReliabilityBin> probabilities;  ///< stated probability of a touch against the fraction that touches
};

/// The truth and the statements of one sequence. `poses` says how much of each segment is visible.
struct ContactSequence {
  ResultTable poses;
  ContactTruth truth;
  StatedContacts stated;
};
/// Evaluates several sequences over the frames that all three tables contain. Error: there is no such frame.
Result<ContactEvaluation> evaluate_contacts(const std::vector<ContactSequence>& sequences);

}  // namespace barehand
