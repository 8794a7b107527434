#include "drivers/synthetic/people/handless_motion.h"

#include "drivers/synthetic/people/hand_wandering.h"

namespace barehand::synthetic {

StagedSequence::Setting handless_setting(std::uint64_t seed, KeyedRandom& random) {
  StagedSequence::Setting s;
  s.duration = kHandlessDuration;
  s.seed = seed;
  s.camera.clear();
  for (double time = 0; time <= kHandlessDuration; time += kHandlessStep)
    s.camera.push_back({time, random_within({0.1, 0.1, 0.08}, random), random_within({0.12, 0.12, 0.12}, random)});
  return s;
}

}  // namespace barehand::synthetic
