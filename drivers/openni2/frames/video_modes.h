#pragma once

#include <OpenNI.h>

#include <optional>

#include "drivers/openni2/openni_params.h"

namespace barehand {

/// The depth mode nearest to the wanted size, then nearest to the wanted rate, then with the finest unit; none if
/// there is no known format.
std::optional<openni::VideoMode> choose_depth_mode(const openni::SensorInfo& sensor, const OpenNiParams& wanted);

/// A colour mode of exactly the depth image's size with the rate nearest to that of depth; none if no mode fits.
std::optional<openni::VideoMode> choose_colour_mode(const openni::SensorInfo& sensor, const openni::VideoMode& depth);

/// The depth unit of a format [m]; 0 if it is not a depth format.
double depth_unit(openni::PixelFormat format);
/// Bytes per pixel of a colour format; 0 if the format is not known.
int colour_bytes_per_pixel(openni::PixelFormat format);
/// Text for messages, such as "640x480 at 30 Hz".
std::string to_text(const openni::VideoMode& mode);

}  // namespace barehand
