#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/parallel.h"
#include "stages/refinement/scan_equations.h"

namespace barehand {

struct ScanProgress {
  int round = 0, rounds = 0;  ///< finished, of
  double mismatch = 0;        ///< root mean square distance of data and skin along the normal before the round [m]
};

/// Fuses the frames of a scan into a personal hand: Gauss-Newton on all poses, where the joints lie and how they
/// bend, how far every vertex of the skin stands out, and how it follows two bones, all at once. `start`: the hand as
/// fitted while it was tracked, or a measured one, whose joints stay; `cell` [m]: size of the skin's triangles. Same
/// frames, same hand, whatever the number of threads. None: there are no frames, their equations cannot be solved, or
/// the hand explains them worse than before, or it is to stop. Fifty frames take half a second a round.
std::optional<HandProfile> scan_hand(const HandProfile& start, double cell, std::vector<ScanFrame> frames,
                                     Workers& workers, const std::function<void(const ScanProgress&)>& progress = {},
                                     const std::stop_token& stop = {});

}  // namespace barehand
