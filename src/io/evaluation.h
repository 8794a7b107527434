#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/error.h"
#include "io/distribution.h"
#include "io/result_table.h"

namespace barehand {

/// A hand further off than this is lost [m].
inline constexpr double kLostFrameError = 0.020;
/// Truth's visible fraction above which a segment counts as seen, and below which as hidden; between: neither.
inline constexpr double kSeen = 0.5, kHidden = 0.1;

/// Which frames a run was meant to track, as given to `barehand track`.
struct ExpectedFrames {
  std::optional<std::int64_t> start;  ///< first frame; not given: the first of the truth, backwards the last
  std::int64_t step = 1;              ///< every step-th frame, negative: backwards; not 0
};

/// Errors of one frame [m].
struct FrameErrors {
  std::int64_t number = 0;
  double timestamp = 0;                          ///< seconds
  bool tracked = false;                          ///< the result has rows; otherwise there are no errors
  std::array<double, kSegmentCount> segments{};  ///< mean distance of both ends to the truth's (paper Sec. 5.1)
  double mean = 0;                               ///< frame error: mean over all 16 segments
  double mean_without_palm = 0;                  ///< mean over the 15 phalanges
  bool lost() const { return !tracked || mean > kLostFrameError; }
};

/// The hand came back into view.
struct Return {
  std::int64_t number = 0;    ///< first frame in which half of the hand is seen
  std::optional<int> frames;  ///< from there to the first one that is not lost; none: not before it left again
};

/// The paper's metrics (Sec. 5) of one result against the truth [m]. Frames without rows enter no mean; they count as
/// lost.
struct Evaluation {
  std::vector<FrameErrors> frames;  ///< every expected frame of the truth, in its order
  std::size_t untracked = 0;        ///< frames without rows
  std::vector<std::int64_t> lost;   ///< numbers of the frames without rows or with too large an error
  Distribution frame_error, frame_error_without_palm;
  Distribution segment_error;  ///< over all segments of all frames
  Distribution seen, hidden;   ///< of the segments that are visible in truth, and that are not
  std::array<Distribution, kSegmentCount> per_segment;
  std::vector<Return> returns;         ///< of the hand, after frames of which the truth has no rows
  std::vector<std::int64_t> phantoms;  ///< frames with rows in which the truth has none
  Distribution joint_gap;              ///< between adjacent ends in the result, joints of the palm left out
};

/// Error: the tables have no frame in common, or a frame's time stamps differ by more than 1 ms.
Result<Evaluation> evaluate(const ResultTable& truth, const ResultTable& result, const ExpectedFrames& expected = {});

/// Mean distance of both ends [m].
double segment_error(const TableRow& truth, const TableRow& result);

}  // namespace barehand
