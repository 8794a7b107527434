#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "drivers/openni2/frames/colour_pairing.h"
#include "drivers/openni2/frames/device_clock.h"
#include "drivers/openni2/live_output.h"
#include "drivers/openni2/sensor.h"
#include "sensor/picture_check.h"

namespace barehand {

/// Reads an open live sensor until it is lost: pairs its depth and colour images, gives them time stamps of the host's
/// clock, checks them and delivers them as frames. Used by one thread.
class LiveSession {
 public:
  LiveSession(std::unique_ptr<OpenNiSensor> sensor, const OpenNiParams& params, LiveOutput& output, const Clock& clock,
              const std::atomic<bool>& stop);

  /// The reason why a sensor must be opened again.
  struct Loss {
    std::string kind, what, remedy;
  };
  /// Reads and delivers what arrives within a short time; if the sensor was lost and
  /// must be opened again, returns why.
  std::optional<Loss> step();

  const std::string& where() const { return sensor_->where(); }
  /// Whether a valid frame has arrived.
  bool proven() const { return before_ != nullptr; }

 private:
  using Pairing = ColourPairing<openni::VideoFrameRef>;

  // Takes an image from the sensor.
  void take(OpenNiSensor::Picture picture);
  // Checks a pair of images and delivers it as a frame.
  void deliver(const Pairing::Pair& pair);
  // Computes the capture time.
  void stamp(const Pairing::Stamped& depth, RgbdFrame& frame);
  void add_colour(const std::optional<openni::VideoFrameRef>& picture, RgbdFrame& frame);
  // Checks whether paired streams really expose at the same time; `matched`: this depth image had its colour.
  void verify_step(bool matched);
  // Switch the pairing of the streams on again after colour has returned (pair_again) or after both streams had stopped
  // (resume_step), or off permanently (give_up_step).
  void pair_again();
  void resume_step();
  void give_up_step();
  // Counts and reports faults of the depth image.
  void report_depth_fault(DepthFault fault);
  // Notices when colour stops and when it returns.
  void watch_colour();
  std::optional<Loss> loss();
  // Whether no depth has arrived for `factor` times the time after which the sensor counts as stalled.
  bool depth_missing_for(double factor) const;
  std::int64_t wait_us() const;

  std::unique_ptr<OpenNiSensor> sensor_;
  const OpenNiParams params_;
  LiveOutput& output_;
  const Clock& clock_;
  const std::atomic<bool>& stop_;
  const std::int64_t period_us_;
  bool pair_wanted_;  ///< whether the sensor can expose depth and colour at the same time
  Pairing pairing_;
  DeviceClock device_clock_;
  FramePtr before_;  ///< the last valid frame

  std::int64_t now_us_, last_depth_us_, last_colour_us_;  // times by the host's steady clock [us]
  int depth_since_colour_ = 0, out_of_step_ = 0;
  int in_step_ = 0;  ///< number of frames with colour since the streams were paired
  bool any_depth_ = false, colour_missing_ = false, pairing_held_all_ = false;
  static constexpr int kPairings = 3;
  int pairings_left_ = kPairings;  ///< attempts left, since an unreliable colour camera must not interrupt depth often
  DepthFault fault_ = DepthFault::none;
  std::int64_t fault_since_us_ = 0, black_since_us_ = 0;
  std::optional<std::int64_t> epoch_us_;  ///< host time at the zero of the steady clock [us]
};

}  // namespace barehand
