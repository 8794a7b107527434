#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "drivers/lcm/foreign_frames.h"
#include "drivers/lcm/lcm_listener.h"
#include "math/source.h"

namespace barehand {

struct LcmLiveOptions {
  std::string channel = "*RGBD_FRAME";  ///< glob
  ForeignCamera foreign = {};
  std::size_t capacity =
      1;  ///< messages that may wait; 1: the newest wins (tracking), more: none is missed (recording)
};

/// Counts since the start: received = delivered + replaced + waiting.
struct LcmLiveCounts {
  std::int64_t received = 0;
  std::int64_t replaced = 0;  ///< the oldest waiting, thrown away because a newer one needed its place
  std::int64_t lost = 0;      ///< numbered by the sender (seq) but never arrived
};

/// Frames from a live LCM bus. A thread receives and keeps the newest messages; `next` decodes the oldest of them. A
/// message of a wrong type, a damaged one and one that repeats or precedes the last frame come as SkippedFrame.
class LcmLiveSource : public FrameSource {
 public:
  static Result<std::unique_ptr<LcmLiveSource>> open(const std::string& url, const LcmLiveOptions& options = {});
  LcmLiveSource(std::shared_ptr<LcmBus> bus, const LcmLiveOptions& options);

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return true; }
  std::string name() const override { return "lcm:" + bus_->url(); }

  /// "transit", the way from the sender, and "inbox", the messages that wait here.
  std::vector<QueueHealth> queues() const override;
  LcmLiveCounts counts() const;

 private:
  struct Letter {
    std::string channel;
    std::vector<std::uint8_t> message;
  };
  void receive(const std::string& channel, WireBytes message);
  void count_lost(const std::string& channel, std::int64_t seq);
  SourceEvent open_letter(const Letter& letter);

  std::shared_ptr<LcmBus> bus_;
  LcmLiveOptions options_;
  std::map<std::string, std::int64_t> last_utime_;  ///< per channel, of the last frame delivered; used by `next` only
  std::int64_t foreign_number_ = 0;

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable arrived_;
  std::deque<Letter> letters_;
  LcmLiveCounts counts_;
  std::map<std::string, std::int64_t> last_seq_;

  LcmListener listener_;  ///< last: its thread uses everything above
};

}  // namespace barehand
