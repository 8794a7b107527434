#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/shared/depth_range.h"
#include "core/clock.h"
#include "core/error.h"
#include "drivers/openni2/openni_params.h"
#include "hand/profile.h"
#include "sensor/frame_source.h"
#include "sensor/given_intrinsics.h"

namespace barehand {

/// The source of frames that the user asks for by `--source` and the options that belong to it.
struct SourceRequest {
  std::string spec;                   ///< folder:DIR | log:FILE | lcm | openni2[:SENSOR|:FILE.oni] | sim:NAME
  std::optional<std::int64_t> start;  ///< first frame of a recording
  std::int64_t step = 1;              ///< every step-th frame; negative plays backwards
  std::string lcm_url;                ///< for the source `lcm`; "": LCM's default
  std::string channel;                ///< glob of LCM channels with frames; "": the driver chooses one
  GivenIntrinsics foreign;            ///< intrinsics of frames that come without
  OpenNiParams openni2;               ///< wanted mode of a sensor
  std::size_t live_capacity = 1;      ///< largest number of live frames that wait; 1: only the newest
  DepthLimits depth;                  ///< range in which a hand is searched; nothing measured there leads to a warning
};

/// A hand whose profile comes with a source of frames.
struct SourceHand {
  std::function<Result<HandProfile>()> load;  ///< reads the hand's profile
  std::string name;                           ///< where the profile comes from, for messages
};

struct OpenSource {
  std::unique_ptr<FrameSource> source;
  std::vector<SourceHand> hands;       ///< exactly the hands in the frames, in the source's order; empty: not known
  double fps = 0;                      ///< nominal rate at which frames come; 0: not known
  std::optional<std::int64_t> frames;  ///< number of frames to come, if known
  std::vector<std::string> warnings;   ///< problems to report, although the source could be opened
  std::string if_silent;               ///< what the user should check if no frames come, as a sentence
};

/// Whether a failure to open this source may be one of the network, which may become available later.
bool needs_network(const SourceRequest& request);
/// Opens a source. Errors: an unknown kind of source, and those of its driver (no such file, no frames, no multicast
/// route, ...). `clock` must outlive the source; it paces a live simulator.
Result<OpenSource> open_source(const SourceRequest& request, const Clock& clock);

}  // namespace barehand
