#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/error.h"
#include "evaluation/distribution.h"
#include "io/hand/result_table.h"

namespace barehand {

// Errors of a tracking result compared with the truth.

/// A frame with a larger error counts as lost [m].
inline constexpr double kLostFrameError = 0.020;
/// A segment counts as seen if its visible fraction in the truth is above kSeen, as hidden if it is below kHidden, and
/// as neither in between.
inline constexpr double kSeen = 0.5, kHidden = 0.1;

/// The frames that a run was meant to track, as given to `barehand track`.
struct ExpectedFrames {
  std::optional<std::int64_t> start;  ///< first frame; none: the first of the truth, or its last if step < 0
  std::int64_t step = 1;              ///< every step-th frame; negative: backwards; not 0
};

/// Errors of one frame [m].
struct FrameErrors {
  std::int64_t number = 0;
  double timestamp = 0;                          ///< seconds
  bool tracked = false;                          ///< the result has rows for this frame; otherwise there are no errors
  std::array<double, kSegmentCount> segments{};  ///< error of each segment: see segment_error() (paper Sec. 5.1)
  double mean = 0;                               ///< frame error: mean over all 16 segments
  double mean_without_palm = 0;                  ///< mean over the 15 phalanges
  bool lost() const { return !tracked || mean > kLostFrameError; }
};

/// One return of a hand into view.
struct Return {
  std::int64_t number = 0;    ///< first frame in which half of the hand is visible
  std::optional<int> frames;  ///< number of frames until one is not lost; none: the hand left the view before that
};

/// The paper's metrics (Sec. 5) of one result compared with the truth [m]. Frames without rows in the result count as
/// lost and are left out of the means.
struct Evaluation {
  std::vector<FrameErrors> frames;  ///< all expected frames of the truth, in its order
  std::size_t untracked = 0;        ///< number of frames without rows in the result
  std::vector<std::int64_t> lost;   ///< numbers of the lost frames
  Distribution frame_error, frame_error_without_palm;
  Distribution segment_error;  ///< errors of all segments of all frames
  Distribution seen, hidden;   ///< errors of the segments that are visible, or hidden, according to the truth
  std::array<Distribution, kSegmentCount> per_segment;
  std::vector<Return> returns;            ///< returns of the hand after frames for which the truth has no rows
  std::vector<std::int64_t> false_hands;  ///< frames with rows in the result but none in the truth
  Distribution joint_gap;                 ///< distances of adjacent ends in the result, without the joints of the palm
};

/// Compares a result with the truth. Errors: the tables have no frame in common, the truth has none of the expected
/// frames, or the time stamps of a frame differ by more than 1 ms.
Result<Evaluation> evaluate(const ResultTable& truth, const ResultTable& result, const ExpectedFrames& expected = {});

/// Mean distance of the two ends of a segment from the truth [m].
double segment_error(const TableRow& truth, const TableRow& result);

}  // namespace barehand
