#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

// Checks the time stamps of a source's frames, and numbers the frames.

/// Time stamps farther from the epoch than this [us], before or after it, are rejected: they are in another unit, and a
/// result table could not represent them with its precision.
inline constexpr std::int64_t kLatestUtime = 100'000'000'000'000'000;

/// If a time stamp is earlier than the previous one by at least this [us], the recorder was restarted. If it is earlier
/// by less than this, the frame is a repetition or arrived late.
inline constexpr std::int64_t kRestart = 1'000'000;

/// The unit in which a source states its time stamps. It is only used in messages for the user.
enum class StampUnit { seconds, microseconds };

/// Explains a stamp that is beyond kLatestUtime when read in `unit`, for example "this looks like milliseconds since
/// the epoch, but stamps are in seconds: divide it by 1000".
std::string too_late(double stamp, StampUnit unit);

/// Explains times between successive frames [us] that no camera has when its stamps are read in `unit`, for example
/// "stamps are in seconds, and the frames are 33 s apart: these look like milliseconds: divide them by 1e3". `last`:
/// one of the stamps [us]. "" if the times are plausible, or too few.
std::string unlikely_steps(std::vector<std::int64_t> steps, std::int64_t last, StampUnit unit);

/// Checks the time stamps and sets the frame numbers of one channel by the rules in docs/formats.md, "Time". Every
/// source but OpenNI2, whose stamps DeviceClock makes, calls number() for every frame, in the order in which the frames
/// were recorded or arrive.
///  - A frame whose stamp equals the previous one, or is earlier by less than a second, is a repetition or late: it is
///    not used.
///  - A stamp that is earlier by a second or more is a restart: the recorder was started again, or its clock was set.
///  - Frame numbers increase. If they do not, the sender has restarted its count; the numbers continue from the last.
///  - Stamps are used unchanged. If they look like another unit, the user is warned, but they are never converted; a
///    frame whose stamp cannot be a time in the unit is not used.
class FrameOrder {
 public:
  explicit FrameOrder(StampUnit unit) : unit_(unit) {}

  /// Returns the number that the frame gets. The error says why a frame is not used.
  Result<std::int64_t> number(std::int64_t utime, std::int64_t number);

  /// Returns the warnings about the frames since the last call, each only once.
  std::vector<std::string> take_warnings();
  /// Like take_warnings(), to be called after the last frame: also checks a recording that was too short until then,
  /// and counts the unused frames.
  std::vector<std::string> take_last_warnings();

 private:
  void check_restart(std::int64_t utime, std::int64_t number);
  std::int64_t going_on(std::int64_t number);
  void check_steps();

  StampUnit unit_;
  std::int64_t last_utime_ = 0, last_number_ = 0;
  std::int64_t number_shift_ = 0;
  std::int64_t frames_ = 0, unused_ = 0;
  bool begun_ = false, said_restart_ = false, steps_checked_ = false;
  std::vector<std::int64_t> steps_;  ///< times between the first frames [us]
  std::vector<std::string> warnings_;
};

}  // namespace barehand
