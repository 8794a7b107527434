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

// A source of the frames that arrive on a live LCM bus.

struct LcmLiveOptions {
  std::string channel = {};  ///< glob of which the first channel on which a frame arrives counts; "": *RGBD_FRAME
  GivenIntrinsics foreign = {};
  std::size_t capacity = 1;  ///< largest number of waiting messages: 1 to track the newest, more to record all
};

/// Counts since the start: received = delivered + replaced + waiting.
struct LcmLiveCounts {
  std::int64_t received = 0;
  std::int64_t replaced = 0;  ///< messages dropped while they waited, because newer ones arrived
  std::int64_t lost = 0;      ///< messages that the sender numbered (seq) but that never arrived
};

/// Frames from a live LCM bus. A thread receives and keeps the newest messages; `next` decodes the oldest of them. A
/// message of a wrong type, a damaged one and a frame that FrameOrder rejects come as SkippedFrame. Frames on other
/// channels than the chosen one are ignored; this is reported once.
class LcmLiveSource : public FrameSource {
 public:
  static Result<std::unique_ptr<LcmLiveSource>> open(const std::string& url, const LcmLiveOptions& options = {});
  LcmLiveSource(std::shared_ptr<LcmBus> bus, const LcmLiveOptions& options);

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return true; }
  std::string name() const override { return name_of(pattern()); }

  /// "transit" counts the messages on the way from the sender, "inbox" those that wait here.
  std::vector<QueueHealth> queues() const override;
  LcmLiveCounts counts() const;

 private:
  struct Packet {
    std::string channel;
    std::vector<std::uint8_t> message;
  };
  /// Who sent the first frame of a channel.
  struct Sender {
    std::string sensor;
    int width = 0, height = 0;  // of its images [px]
    bool alone = true;          // whether no other one has been reported
  };
  void receive(const std::string& channel, WireBytes message);
  void count_lost(const std::string& channel, std::int64_t seq);
  SourceEvent decode_packet(const Packet& packet);
  SourceEvent take_next();
  void choose(const std::string& channel);
  void tell_of_senders(const std::string& channel, const RgbdFrame& frame);
  void tell_of_jumps(const std::string& channel);
  std::string pattern() const { return options_.channel.empty() ? "*RGBD_FRAME" : options_.channel; }
  std::string name_of(const std::string& channel) const { return "lcm:" + bus_->url() + " " + channel; }

  std::shared_ptr<LcmBus> bus_;
  LcmLiveOptions options_;
  std::map<std::string, FrameOrder> orders_;  ///< per channel; only `next` uses this and the three members below
  std::map<std::string, Sender> senders_;     ///< per channel
  std::int64_t foreign_number_ = 0;
  std::deque<SourceEvent> to_come_;  ///< events to deliver before another message is decoded

  mutable std::mutex mutex_;  ///< guards the members below, except listener_
  std::condition_variable arrived_;
  std::deque<Packet> packets_;
  LcmLiveCounts counts_;
  /// The sequence numbers of a channel.
  struct Sequence {
    std::int64_t last;      // newest number
    std::int64_t lost = 0;  // numbers that did not come
    int late = 0;           // messages in a row that came after a newer one
    int since_jump = 0;     // messages since the numbers jumped last
    int jumps = 0;          // jumps that followed one another closely
    bool counts = true;     // false: the numbers jump too often to tell what is lost
    bool told = false;      // whether that has been reported
  };
  std::map<std::string, Sequence> sequences_;
  std::string chosen_;  ///< the only channel that is accepted; "": none has brought a frame yet
  std::string other_;   ///< another channel on which frames arrived; "": there is none
  bool told_of_other_ = false;

  LcmListener listener_;  ///< declared last: its thread uses the members above
};

}  // namespace barehand
