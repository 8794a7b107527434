#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace barehand::virtual_openni {

/// The properties and faults of the virtual sensor, as its control file states them: one "key=value" per line.
struct Settings {
  // These are read when the sensor is opened.
  std::string sim = "fist,noise=kinect,width=160,height=120";  ///< simulated scene; what follows "sim:"
  int frames = 15;                                             ///< frames of the scene, played forth and back
  bool colour = true;                                          ///< the sensor has a colour camera
  bool registration = true, sync = true;                       ///< the sensor supports these
  bool upright = false;       ///< the second depth mode has its width and height exchanged
  bool field_of_view = true;  ///< the sensor states its field of view
  bool mirror_fixed = false;  ///< images are mirrored, which cannot be switched off
  bool lies = false;          ///< the sensor accepts registration and sync but does neither

  // Changes of these are applied at once.
  bool plugged = true;
  std::string uri = "virtual/1";  ///< changes when the sensor is plugged in again, as on a USB bus
  std::string second_uri;         ///< address of a second sensor; "": there is none
  double fps = 30;
  double latency = 0.005;           ///< s, from the exposure to the arrival of a frame
  double drift_ppm = 0;             ///< of the sensor's clock relative to the host's
  std::int64_t clock_offset_us = 0; /**< of the sensor's clock; a change is a jump */
  /// One of: none; open (cannot be opened); start (streams do not start); stall; hang (stop blocks); garbage; short
  /// (truncated frames); black; frozen; no_colour; black_colour.
  std::string fault = "none";
  bool cured_by_reopen = false;  ///< the fault ends when the sensor is opened again
};

/// The settings in the file that the environment variable BAREHAND_VIRTUAL_OPENNI2 names; without it, the defaults. A
/// value that cannot be read is reported on standard error, and the settings before it stay in force.
std::shared_ptr<const Settings> read_settings();

}  // namespace barehand::virtual_openni
