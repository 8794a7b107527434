// Chooses the number of samples with which a GPU keeps the time limit of a search level.
#include "tracking/hypotheses/sample_budget.h"

#include <algorithm>
#include <array>

#include "core/format.h"

namespace barehand {
namespace {

constexpr int kRuns = 3;  // timed runs for each number of samples, after an untimed one that allocates the buffers
// Ratio of successive numbers of samples. The time of a search level grows at most with their square, so each step
// increases it by less than half.
constexpr double kGrowth = 1.2;

}  // namespace

double SampleBudget::seconds(const Level& level, int samples) const {
  std::array<std::int64_t, kRuns> us{};
  level(samples);
  for (std::int64_t& run : us) {
    const std::int64_t start = clock_->steady_us();
    level(samples);
    run = clock_->steady_us() - start;
  }
  std::sort(us.begin(), us.end());
  return static_cast<double>(us[kRuns / 2]) * 1e-6;
}

void SampleBudget::measure(const Level& level) {
  on_device_ = params_.samples;
  level_seconds_ = 0;
  while (on_device_ < params_.samples_on_device) {
    const int more = std::max(on_device_ + 1, static_cast<int>(on_device_ * kGrowth));
    const int next = std::min(params_.samples_on_device, more);
    const double taken = seconds(level, next);
    if (taken > params_.level_budget_ms * 1e-3) return;
    on_device_ = next;
    level_seconds_ = taken;
  }
}

std::string SampleBudget::to_text() const {
  const double budget = params_.level_budget_ms;
  if (level_seconds_ == 0)
    return formatted("%d samples per segment and level, as on the CPU: more would take longer than %g ms", on_device_,
                     budget);
  return formatted(
      "%d samples per segment and level where the GPU compares them, %d on the CPU: a level takes %.2f of "
      "%g ms",
      on_device_, params_.samples, 1e3 * level_seconds_, budget);
}

}  // namespace barehand
