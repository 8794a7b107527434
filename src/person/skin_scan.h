#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/parallel/parallel.h"
#include "person/scan_equations.h"

namespace barehand {

/// What a scan reports after each round.
struct ScanProgress {
  int round = 0, rounds = 0;  ///< rounds finished, and rounds in total
  double mismatch = 0;        ///< root mean square distance of data and skin along the normal before the round [m]
};

/// Fuses the frames of a scan into a personal hand. Gauss-Newton optimises all poses, the positions and axes of the
/// joints, the offset of every skin vertex and its skinning weights together. `start`: the hand fitted while tracking,
/// or a measured one, whose joints stay fixed. `cell`: size of the skin's triangles [m]. The result does not depend on
/// the number of threads. None: there are no frames, their equations cannot be solved, the hand fits them worse than at
/// the beginning, or `stop` was requested. Fifty frames take about half a second per round.
std::optional<HandProfile> scan_hand(const HandProfile& start, double cell, std::vector<ScanFrame> frames,
                                     Workers& workers, const std::function<void(const ScanProgress&)>& progress = {},
                                     const std::stop_token& stop = {});

}  // namespace barehand
