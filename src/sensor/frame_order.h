#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// Latest time that is believed of a stamp [us], before or after the epoch: beyond it stamps are in another unit, and a
/// table could not hold them with its precision.
inline constexpr std::int64_t kLatestUtime = 100'000'000'000'000'000;

/// A stamp that is earlier by this [us] is a new start; by less, a repetition or a frame that was overtaken.
inline constexpr std::int64_t kRestart = 1'000'000;

/// The unit that a source's stamps are stated in, for messages.
enum class StampUnit { seconds, microseconds };

/// "These look like milliseconds since the epoch: divide them by 1000", of a stamp that is beyond kLatestUtime when it
/// is taken for one in `unit`.
std::string too_late(double stamp, StampUnit unit);

/// The one rule for time stamps and frame numbers (docs/formats.md, "Time"): every source asks it about every frame of
/// a channel, in the order in which they were recorded or arrive.
///  - A frame with the stamp of the one before, or earlier by less than a second, is a repetition or was overtaken on
///  the
///    way: it is not used.
///  - One that is earlier by a second or more is a new start: the recorder was started again, or its clock was set.
///  - Numbers rise. Where they do not, the sender counts anew, and the numbers go on after the last one.
///  - Stamps are taken as they are. What looks like another unit is said, never converted; what cannot be a time in the
///    unit is not used.
class FrameOrder {
 public:
  explicit FrameOrder(StampUnit unit) : unit_(unit) {}

  /// The number that the frame gets, or why it is not used.
  Result<std::int64_t> number(std::int64_t utime, std::int64_t number);

  /// What is to be said of the frames since the last call, each thing once.
  std::vector<std::string> take_doubts();
  /// The same after the last frame of a recording, which may be too short for the rest.
  std::vector<std::string> take_last_doubts();

 private:
  void look_at_restart(std::int64_t utime, std::int64_t number);
  std::int64_t going_on(std::int64_t number);
  void look_at_steps();

  StampUnit unit_;
  std::int64_t last_utime_ = 0, last_number_ = 0;
  std::int64_t number_shift_ = 0;
  std::int64_t frames_ = 0, unused_ = 0;
  bool begun_ = false, said_restart_ = false, judged_steps_ = false;
  std::vector<std::int64_t> steps_;  ///< times between the first frames [us]
  std::vector<std::string> doubts_;
};

}  // namespace barehand
