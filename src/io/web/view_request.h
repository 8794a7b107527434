#pragma once

#include <cstdint>
#include <string_view>
#include <variant>

#include "core/error.h"

namespace barehand {

// Messages of the page's WebSocket from a client to the program (docs/view_protocol.md).

enum class ViewPicture { none, colour, depth };
enum class ViewCloud { none, hand, scene };

/// The parts that a client wants of every frame from now on.
struct ViewSettings {
  ViewCloud cloud = ViewCloud::none;
  ViewPicture picture = ViewPicture::none;
  bool large = false;  ///< whether the picture is at most kLargeWidth instead of kSmallWidth wide (ViewFrame)
  double rate = 60;    ///< maximum number of frames per second
  int window = 0;      ///< maximum number of unacknowledged frames; 0: the client does not acknowledge
};

/// A frame has been shown, so another one may be sent.
struct ViewAcknowledge {};

/// A command for the log that is played. It applies to all clients, which see the same frame.
struct PlayerCommand {
  enum class Kind { play, pause, seek, step, speed, lost } kind = Kind::pause;
  /// seek: number of the frame, from 0; step: number of frames to go, backwards if negative; speed: a factor; lost: 1
  /// goes to the next sequence of frames without a pose, -1 to the previous one.
  double value = 0;
};

/// Starts or stops the recording of live frames. The client cannot choose the file.
struct RecordCommand {
  bool on = false;
};

using ViewRequest = std::variant<ViewSettings, ViewAcknowledge, PlayerCommand, RecordCommand>;

/// Parses what a client sends: {"type": "want", "cloud": "hand", "picture": "colour", "rate": 30, "window": 2},
/// {"type": "ack"}, {"type": "seek", "value": 12}, {"type": "record", "on": true} and so on. Errors: invalid JSON, an
/// unknown type, an unknown key, a value out of range.
Result<ViewRequest> parse_view_request(std::string_view text);

}  // namespace barehand
