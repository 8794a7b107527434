#pragma once

#include <memory>
#include <string>

#include "core/error.h"
#include "math/source.h"

namespace barehand {

/// A driver to copy (docs/adding_a_driver.md): a "camera" before a wall that swings to and fro. It delivers exact depth
/// without colour, and it is what a driver must be: frames in order with capture times, intrinsics and depth unit, an
/// end, errors as values, and no state outside the object.
class PlaneSource : public FrameSource {
 public:
  struct Options {
    int frames = 90;
    double fps = 30;
    double near = 0.5, far = 1.0;  ///< the wall swings between these distances [m]
  };

  /// Checks everything that can be wrong before the first frame. Errors: no frames, a rate or distances that no camera
  /// has.
  static Result<std::unique_ptr<PlaneSource>> open(const Options& options);

  SourceEvent next(std::chrono::milliseconds patience) override;
  /// False: this source has time; every frame is delivered. A sensor's driver says true, and its frames may be dropped
  /// when the tracker is slow.
  bool live() const override { return false; }
  std::string name() const override { return "plane"; }

 private:
  explicit PlaneSource(const Options& options) : options_(options) {}

  Options options_;
  std::int64_t next_ = 0;
};

}  // namespace barehand
