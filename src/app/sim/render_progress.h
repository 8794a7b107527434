#pragma once

#include <cstdint>

namespace barehand {

/// Says on standard error how far a rendering is: a line that is rewritten on a terminal, a line at every tenth of the
/// work elsewhere. Always true (go on), as run_sim asks.
bool render_progress(std::int64_t done, std::int64_t all);

}  // namespace barehand
