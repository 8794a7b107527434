#pragma once

#include <OpenNI.h>

#include <optional>

#include "drivers/openni2/openni_params.h"

namespace barehand {

/// The depth mode nearest to the wanted size, then rate, then with the finer unit; none: no format that is known.
std::optional<openni::VideoMode> choose_depth_mode(const openni::SensorInfo& sensor, const OpenNiParams& wanted);

/// A colour mode of exactly the depth image's size, the rate nearest to its rate; none: there is no such mode.
std::optional<openni::VideoMode> choose_colour_mode(const openni::SensorInfo& sensor, const openni::VideoMode& depth);

/// [m] per count; 0: not a depth format.
double depth_unit(openni::PixelFormat format);
/// 0: a format that is not known.
int colour_bytes_per_pixel(openni::PixelFormat format);
/// "640x480 at 30 Hz".
std::string to_text(const openni::VideoMode& mode);

}  // namespace barehand
