#pragma once

namespace barehand {

/// How well the poses of a track normally explain the data: a running mean of their scores that falls fast and rises
/// slowly. Frames in which fingers are confused with their neighbours therefore stand out against earlier, better
/// frames. The mean starts below the first score, since a hand may be found in a wrong pose.
class BaselineScore {
 public:
  void reset() { level_ = 0; }
  /// Adds a tracked frame's global score [m].
  void update(double score) {
    constexpr double kStart = 0.7, kFall = 0.2, kRise = 0.01;
    if (level_ == 0) level_ = kStart * score;
    level_ += (score < level_ ? kFall : kRise) * (score - level_);
  }
  /// The baseline score [m]; 0 before the first frame.
  double level() const { return level_; }

 private:
  double level_ = 0;
};

}  // namespace barehand
