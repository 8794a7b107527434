#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace barehand::virtual_openni {

/// What the virtual sensor is and what is wrong with it, as its control file says: "key=value" a line.
struct Settings {
  // Read when the sensor is opened.
  std::string sim = "fist,noise=kinect,width=160,height=120";  ///< simulated scene, as after "sim:"
  int frames = 15;                                             ///< of the scene, played forth and back
  bool colour = true;                                          ///< has a colour camera
  bool registration = true, sync = true;                       ///< can do that
  bool upright = false;                                        ///< its finer depth mode, which does not work
  bool field_of_view = true;                                   ///< tells it
  bool mirror_fixed = false;                                   ///< mirrored, and cannot be turned off
  bool lies = false;                                           ///< accepts registration and sync and does neither

  // In force at once.
  bool plugged = true;
  std::string uri = "virtual/1";  ///< another one after a re-plug, as on a USB bus
  std::string second_uri;         ///< of a second sensor; "": there is none
  double fps = 30;
  double latency = 0.005;           ///< [s] from the exposure to the arrival of a frame
  double drift_ppm = 0;             ///< of the sensor's clock against the host's
  std::int64_t clock_offset_us = 0; /**< of the sensor's clock; a change is a jump */
  /// none, open (cannot be opened), start (streams do not start), stall, hang (stop blocks), garbage, short (truncated
  /// frames), black, frozen, no_colour, black_colour
  std::string fault = "none";
  bool cured_by_reopen = false;  ///< the fault ends when the sensor is opened again
};

/// Settings written in a file that the environment variable BAREHAND_VIRTUAL_OPENNI2 names; without either the
/// defaults. A value that cannot be read is said on standard error, and the settings before it stay.
std::shared_ptr<const Settings> read_settings();

}  // namespace barehand::virtual_openni
