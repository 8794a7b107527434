#pragma once

#include <cstdint>

namespace barehand {

/// Prints the progress of a rendering to standard error: on a terminal as one line that is rewritten, otherwise as a
/// line at every tenth of the frames. Returns true, which makes run_sim continue.
bool render_progress(std::int64_t done, std::int64_t all);

}  // namespace barehand
