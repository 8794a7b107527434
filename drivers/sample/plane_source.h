#pragma once

#include <memory>
#include <string>

#include "core/error.h"
#include "sensor/frame_source.h"

namespace barehand {

/// A driver to copy (docs/adding_a_driver.md). It simulates a camera in front of a wall that swings back and forth,
/// and delivers exact depth without colour. It has everything that a driver needs: frames in order with capture times,
/// intrinsics and a depth unit, an end, errors as values, and no state outside the object.
class PlaneSource : public FrameSource {
 public:
  struct Options {
    int frames = 90;
    double fps = 30;
    double near = 0.5, far = 1.0;  ///< nearest and farthest distance of the wall [m]
  };

  /// Checks everything before the first frame. Errors: no frames, or a rate or distances that no camera has.
  static Result<std::unique_ptr<PlaneSource>> open(const Options& options);

  SourceEvent next(std::chrono::milliseconds patience) override;
  /// Returns false, since this source can wait, so that every frame is delivered. The driver of a sensor returns true;
  /// its frames may be dropped when the tracker is slow.
  bool live() const override { return false; }
  std::string name() const override { return "plane"; }

 private:
  explicit PlaneSource(const Options& options) : options_(options) {}

  Options options_;
  std::int64_t next_ = 0;
};

}  // namespace barehand
