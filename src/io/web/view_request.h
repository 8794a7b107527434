#pragma once

#include <cstdint>
#include <string_view>
#include <variant>

#include "core/error.h"

namespace barehand {

enum class ViewPicture { none, colour, depth };
enum class ViewCloud { none, hand, scene };

/// What a client wants of every frame, from now on.
struct ViewWish {
  ViewCloud cloud = ViewCloud::none;
  ViewPicture picture = ViewPicture::none;
  bool large = false;  ///< the picture: as it is instead of small
  double rate = 60;    ///< frames a second at most
  int window = 0;      ///< frames that may be under way before the client acknowledges one; 0: it does not acknowledge
};

/// A frame has been shown; another one may come.
struct ViewAcknowledge {};

/// What a client wants of a log that is played. Every client sees the same.
struct PlayerCommand {
  enum class Kind { play, pause, seek, step, speed, lost } kind = Kind::pause;
  /// seek: position among the frames, from 0; step: frames to go, backwards if negative; speed: a factor; lost: 1 to
  /// the next frame without a pose, -1 to the one before.
  double value = 0;
};

/// Start or stop the recording of what comes live. Where it goes is not the client's choice.
struct RecordCommand {
  bool on = false;
};

using ViewDemand = std::variant<ViewWish, ViewAcknowledge, PlayerCommand, RecordCommand>;

/// Parses what a client sends: {"type": "want", "cloud": "hand", "picture": "colour", "rate": 30, "window": 2},
/// {"type": "ack"}, {"type": "seek", "value": 12}, {"type": "record", "on": true} and so on. Errors: no JSON, an
/// unknown type, a value out of range, a command to record that says more.
Result<ViewDemand> parse_view_demand(std::string_view text);

}  // namespace barehand
