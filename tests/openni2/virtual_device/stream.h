#pragma once

#include <mutex>

#include "openni2/virtual_device/oni_driver.h"
#include "openni2/virtual_device/pictures.h"
#include "openni2/virtual_device/settings.h"

namespace barehand::virtual_openni {

/// An exposure, of which each stream delivers its image.
struct Exposure {
  const RgbdFrame* picture = nullptr;
  std::uint64_t device_us = 0;  ///< by the sensor's clock [us]
  int index = 0;
  std::string fault;
  int colour_shift = 0;  ///< px to the right, for colour that is not registered to depth
};

/// The depth or the colour stream of the virtual sensor.
class Stream : public oni::driver::StreamBase {
 public:
  Stream(OniSensorType sensor, const Intrinsics& camera, const Settings& settings);

  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniStatus start() override;
  void stop() override;

  void refuse_start(bool refuse) { refuse_start_ = refuse; }
  void deliver(const Exposure& exposure);
  OniSensorType sensor() const { return sensor_; }
  static OniVideoMode best_mode(OniSensorType sensor, const Intrinsics& camera, double fps);

 private:
  void paint_depth(const Exposure& exposure, std::uint16_t* out) const;
  void paint_colour(const Exposure& exposure, std::uint8_t* out) const;
  bool mode_possible(const OniVideoMode& mode) const;

  const OniSensorType sensor_;
  const Intrinsics camera_;
  const double fps_;
  const bool field_of_view_, mirror_fixed_;
  // Protects the members below; also held while a frame is delivered, so that stop() waits for it.
  mutable std::mutex mutex_;
  OniVideoMode mode_;
  bool mirrored_ = true;  // like a PrimeSense after its start
  bool running_ = false, refuse_start_ = false;
};

}  // namespace barehand::virtual_openni
