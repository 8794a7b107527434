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
#include "sensor/frame_order.h"
#include "sensor/frame_source.h"

namespace barehand {

struct LcmLiveOptions {
  std::string channel = {};  ///< glob; "": of *RGBD_FRAME the first channel that brings a frame, and no other
  GivenIntrinsics foreign = {};
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
/// message of a wrong type, a damaged one and one that FrameOrder does not use come as SkippedFrame. Frames of channels
/// that were not chosen are told of once.
class LcmLiveSource : public FrameSource {
 public:
  static Result<std::unique_ptr<LcmLiveSource>> open(const std::string& url, const LcmLiveOptions& options = {});
  LcmLiveSource(std::shared_ptr<LcmBus> bus, const LcmLiveOptions& options);

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return true; }
  std::string name() const override { return name_of(pattern()); }

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
  SourceEvent take_next();
  void choose(const std::string& channel);
  std::string pattern() const { return options_.channel.empty() ? "*RGBD_FRAME" : options_.channel; }
  std::string name_of(const std::string& channel) const { return "lcm:" + bus_->url() + " " + channel; }

  std::shared_ptr<LcmBus> bus_;
  LcmLiveOptions options_;
  std::map<std::string, FrameOrder> orders_;  ///< per channel; this and what follows is used by `next` only
  std::int64_t foreign_number_ = 0;
  std::deque<SourceEvent> to_come_;  ///< before anything new is read

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable arrived_;
  std::deque<Letter> letters_;
  LcmLiveCounts counts_;
  std::map<std::string, std::int64_t> last_seq_;
  std::string chosen_;  ///< the one channel that is heard; "": all of the pattern
  std::string other_;   ///< another one with frames
  bool told_of_other_ = false;

  LcmListener listener_;  ///< last: its thread uses everything above
};

}  // namespace barehand
