#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "drivers/openni2/colour_pairing.h"
#include "drivers/openni2/device_clock.h"
#include "drivers/openni2/live_output.h"
#include "drivers/openni2/sensor.h"
#include "math/picture_check.h"

namespace barehand {

/// A live sensor from the moment it is open until it is lost: pairs its pictures, stamps, checks and delivers them.
/// One thread.
class LiveSession {
 public:
  LiveSession(std::unique_ptr<OpenNiSensor> sensor, const OpenNiParams& params, LiveOutput& output, const Clock& clock,
              const std::atomic<bool>& stop);

  /// Why a sensor has to be opened again.
  struct Loss {
    std::string kind, what, remedy;
  };
  /// Reads and delivers what comes within a short time.
  std::optional<Loss> step();

  const std::string& where() const { return sensor_->where(); }
  /// Whether a good frame came.
  bool proven() const { return before_ != nullptr; }

 private:
  using Pairing = ColourPairing<openni::VideoFrameRef>;

  void take(OpenNiSensor::Picture picture);
  void deliver(const Pairing::Pair& pair);
  void stamp(const Pairing::Stamped& depth, RgbdFrame& frame);
  void add_colour(const std::optional<openni::VideoFrameRef>& picture, RgbdFrame& frame);
  void verify_step(bool matched);
  void pair_again();
  void resume_step();
  void give_up_step();
  void judge(DepthFault fault);
  void watch_colour();
  std::optional<Loss> loss();
  bool depth_missing_for(double factor) const;
  std::int64_t wait_us() const;

  std::unique_ptr<OpenNiSensor> sensor_;
  const OpenNiParams params_;
  LiveOutput& output_;
  const Clock& clock_;
  const std::atomic<bool>& stop_;
  const std::int64_t period_us_;
  bool pair_wanted_;  ///< the sensor can expose in step
  Pairing pairing_;
  DeviceClock device_clock_;
  FramePtr before_;  ///< last sound frame

  std::int64_t now_us_, last_depth_us_, last_colour_us_;  // steady clock
  int depth_since_colour_ = 0, out_of_step_ = 0;
  int in_step_ = 0;  ///< frames with colour since the streams were paired
  bool any_depth_ = false, colour_missing_ = false, pairing_held_all_ = false;
  static constexpr int kPairings = 3;
  int pairings_left_ = kPairings;  ///< a colour camera that comes and goes must not stop depth each time
  DepthFault fault_ = DepthFault::none;
  std::int64_t fault_since_us_ = 0, black_since_us_ = 0;
  std::optional<std::int64_t> epoch_us_;  ///< host time at the steady clock's zero
};

}  // namespace barehand
