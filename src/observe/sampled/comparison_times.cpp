#include "observe/sampled/comparison_times.h"

#include <algorithm>
#include <array>

#include "core/format.h"

namespace barehand {

// Measures which of two observers, the CPU or a device, compares a batch of sampled poses faster.

namespace {

constexpr int kCalls = 7;  // measured calls of each observer; odd, so that the median is one of them

double median(std::array<double, kCalls>& seconds) {
  std::nth_element(seconds.begin(), seconds.begin() + kCalls / 2, seconds.end());
  return seconds[kCalls / 2];
}

}  // namespace

std::string to_text(const ComparisonTimes& times) {
  const bool faster = times.device_is_faster();
  const double ratio = faster ? times.cpu / std::max(times.device, 1e-6) : times.device / std::max(times.cpu, 1e-6);
  return formatted("a call takes %.2f ms on the CPU and %.2f ms on the device, which is %.1f times as %s",
                   1e3 * times.cpu, 1e3 * times.device, ratio, faster ? "fast" : "slow");
}

Result<ComparisonTimes> time_comparison(const SampleBatch& batch, Observer& cpu, DeviceObserver& device,
                                        const Clock& clock, PatchDistances& distances) {
  std::array<double, kCalls> cpu_seconds{}, device_seconds{};
  const auto elapsed = [&](const auto& call) {
    const std::int64_t start = clock.steady_us();
    call();
    return static_cast<double>(clock.steady_us() - start) * 1e-6;
  };

  // Call both observers in turn, so that other load on the machine affects both equally. The first call of each is not
  // measured, because caches are cold and drivers compile.
  PatchDistances by_device;
  for (int i = -1; i < kCalls; ++i) {
    const double on_cpu = elapsed([&] { cpu.compare(batch, distances); });
    // A changed id makes the device receive the map again.
    const SampleBatch anew{batch.surface, batch.map, i % 2 == 0 ? batch.map_id : ~batch.map_id, batch.poses,
                           batch.first_segment};
    Result<void> done;
    const double on_device = elapsed([&] { done = device.compare(anew, by_device); });
    if (!done) return tl::unexpected(done.error());

    // Keep the times, except those of the first call.
    if (i < 0) continue;
    cpu_seconds[i] = on_cpu;
    device_seconds[i] = on_device;
  }
  return ComparisonTimes{median(cpu_seconds), median(device_seconds)};
}

}  // namespace barehand
