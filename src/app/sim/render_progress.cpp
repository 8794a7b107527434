#include "app/sim/render_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace barehand {

bool render_progress(std::int64_t done, std::int64_t all) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const std::int64_t step = std::max<std::int64_t>(1, all / 10);
  if (terminal)
    std::fprintf(stderr, "\r%lld of %lld frames", static_cast<long long>(done), static_cast<long long>(all));
  if (terminal && done == all) std::fputc('\n', stderr);
  if (!terminal && (done % step == 0 || done == all))
    std::fprintf(stderr, "%lld of %lld frames\n", static_cast<long long>(done), static_cast<long long>(all));
  return true;
}

}  // namespace barehand
