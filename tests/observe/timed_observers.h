#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "observe/sampled/observer.h"

namespace barehand {

/// A batch with a given number of samples, whose poses do not matter.
struct EmptyBatch {
  explicit EmptyBatch(int per_segment) {
    for (auto& of_segment : poses) of_segment.resize(per_segment);
  }
  SampleBatch batch(std::uint64_t map_id = 1) const { return {surface, map, map_id, poses, 0}; }

  std::shared_ptr<const HandSurface> surface;
  PixelMap map;
  std::array<std::vector<SE3>, kSegmentCount> poses;
};

/// The distances that the observers below return for every sample; they identify the observer.
inline constexpr float kByCpu = 1, kByDevice = 2;

inline void say(float distance, const SampleBatch& batch, PatchDistances& distances) {
  for (int s = 0; s < kSegmentCount; ++s) distances[s].assign(batch.poses[s].size(), {distance, 1, 1});
}

/// An observer whose calls take given times; the last time applies to all later calls.
class Stopwatch {
 public:
  Stopwatch(std::shared_ptr<ManualClock> clock, std::deque<std::int64_t> call_us)
      : clock_(std::move(clock)), call_us_(std::move(call_us)) {}
  void pass() {
    clock_->advance(call_us_.front());
    if (call_us_.size() > 1) call_us_.pop_front();
  }

 private:
  std::shared_ptr<ManualClock> clock_;
  std::deque<std::int64_t> call_us_;
};

class TimedCpu final : public Observer {
 public:
  explicit TimedCpu(Stopwatch time) : time_(std::move(time)) {}
  void compare(const SampleBatch& batch, PatchDistances& distances) override {
    time_.pass();
    say(kByCpu, batch, distances);
  }

 private:
  Stopwatch time_;
};

class TimedDevice final : public DeviceObserver {
 public:
  /// The call with the number `failing`, counted from 0, fails; none if negative.
  explicit TimedDevice(Stopwatch time, int failing = -1, std::vector<std::uint64_t>* map_ids = nullptr)
      : time_(std::move(time)), calls_left_(failing), map_ids_(map_ids) {}
  Result<void> compare(const SampleBatch& batch, PatchDistances& distances) override {
    time_.pass();
    if (map_ids_) map_ids_->push_back(batch.map_id);
    say(kByDevice, batch, distances);
    if (calls_left_-- == 0) return fail("gone", "device");
    return {};
  }

 private:
  Stopwatch time_;
  int calls_left_;
  std::vector<std::uint64_t>* map_ids_;
};

}  // namespace barehand
