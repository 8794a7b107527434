#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "drivers/openni2/openni_params.h"
#include "sensor/frame_source.h"

namespace barehand {

class OpenNiFilePlayer;

/// Plays an .oni recording: every depth image once, in order, with the colour image whose time stamp fits. Times count
/// from the first depth image, which gets the time stamp 1 s.
class OpenNiFileSource : public FrameSource {
 public:
  static constexpr std::int64_t kFirstUtime = 1'000'000;

  /// Plays every `step`-th frame (step > 0) from frame `start` on. Errors: there is no such file, it is not a
  /// recording, it has no depth, it has no such frame.
  static Result<std::unique_ptr<OpenNiFileSource>> open(const std::string& path, const OpenNiParams& params,
                                                        std::int64_t start = 0, std::int64_t step = 1);
  ~OpenNiFileSource() override;

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return false; }
  std::string name() const override { return "openni2:" + path_; }
  /// Number of frames that are still to be delivered.
  std::int64_t remaining() const;
  /// Frame rate of the depth stream [Hz].
  double fps() const;
  /// A warning about what the recording lacks; none if it is complete.
  std::optional<std::string> warning() const;

 private:
  OpenNiFileSource(std::string path, std::unique_ptr<OpenNiFilePlayer> player, std::int64_t start, std::int64_t step);

  const std::string path_;
  std::unique_ptr<OpenNiFilePlayer> player_;
  const std::int64_t step_;
  std::int64_t wanted_;  ///< number of the next frame to deliver
};

}  // namespace barehand
