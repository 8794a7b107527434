#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

#include "core/image.h"
#include "io/overlay/overlay_drawing.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// The skin of all hands as the camera sees it. A pixel shows the front-most skin of all hands.
struct SkinLayer {
  /// What one pixel shows.
  struct Pixel {
    float z = 0;               ///< depth of the skin [m]; 0: there is no skin
    cv::Vec3f colour;          ///< R, G, B of the lit skin, in [0, 255]
    float opacity = 0;         ///< opacity of the skin, in [0, 1]
    std::uint8_t hand = 0;     ///< index of the hand
    std::uint8_t segment = 0;  ///< the segment that the skin belongs to
    bool inferred = false;     ///< whether the segment was not measured in this frame
    bool hidden = false;       ///< whether it is farther than the measured depth by more than noise and errors explain
  };
  Image<Pixel> pixels;
  cv::Rect part;  ///< smallest rectangle that contains all pixels with skin
};

/// Renders the hands that have a pose into an image `scale` times as large as the frame: shaded, in the colours of the
/// fingers. The lower the confidence of a segment, the paler and the more transparent it is.
SkinLayer render_skin(const RgbdFrame& frame, int scale, std::span<const DrawnHand> hands);

/// Paints a layer over an image (R, G, B) of the same size, with an outline around each finger. Inferred skin is
/// hatched, and hidden skin is more transparent than other skin.
void paint_skin(const SkinLayer& layer, cv::Mat& picture);

}  // namespace barehand
