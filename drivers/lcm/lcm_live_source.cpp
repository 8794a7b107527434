// Delivers the frames that arrive on a live LCM bus.
#include "drivers/lcm/lcm_live_source.h"

#include <algorithm>
#include <utility>

#include "barehand/rgbd_frame_t.hpp"
#include "core/quote.h"
#include "drivers/lcm/frame_message.h"

namespace barehand {

Result<std::unique_ptr<LcmLiveSource>> LcmLiveSource::open(const std::string& url, const LcmLiveOptions& options) {
  if (!is_utf8(options.channel))
    return fail("LCM cannot listen to a channel whose name is not UTF-8", in_quotes(as_utf8(options.channel)),
                "rename it in the program that sends on it");
  auto bus = LcmBus::open(url);
  if (!bus) return tl::unexpected(bus.error());
  return std::make_unique<LcmLiveSource>(std::move(*bus), options);
}

LcmLiveSource::LcmLiveSource(std::shared_ptr<LcmBus> bus, const LcmLiveOptions& options)
    : bus_(bus),
      options_(options),
      listener_(std::move(bus), pattern(),
                [this](const std::string& channel, WireBytes message) { receive(channel, message); }) {}

void LcmLiveSource::receive(const std::string& channel, WireBytes message) {
  const std::lock_guard lock(mutex_);

  // Ignore the messages of other channels, but remember one that carries frames.
  if (!chosen_.empty() && channel != chosen_) {
    if (carries_frames(message_hash(message))) other_ = channel;
    arrived_.notify_one();
    return;
  }

  // If the queue is full, drop its oldest message.
  ++counts_.received;
  if (packets_.size() >= options_.capacity) {
    packets_.pop_front();
    ++counts_.replaced;
  }

  // Queue the message, after counting the frames that were lost before it.
  if (message_hash(message) == rgbd_frame_t::getHash()) count_lost(channel, message_word(message, 2));
  packets_.push_back({channel, {message.begin(), message.end()}});
  arrived_.notify_one();
}

void LcmLiveSource::count_lost(const std::string& channel, std::int64_t seq) {
  // If the number decreases by more messages, or several times in a row, the sender was restarted. So it was if the
  // number increases by more than comes in some minutes.
  constexpr std::int64_t kReordered = 32, kFarthest = 10'000;
  constexpr int kLateInARow = 3;
  Sequence& numbers = sequences_.try_emplace(channel, Sequence{seq}).first->second;
  if (!numbers.counts) return;
  const std::int64_t step = seq - numbers.last;
  ++numbers.since_jump;

  // A late message may have been counted as lost.
  if (step < 0 && step > -kReordered && ++numbers.late < kLateInARow) {
    const int found = numbers.lost > 0 ? 1 : 0;
    numbers.lost -= found;
    counts_.lost -= found;
    return;
  }

  // Count the numbers that were skipped.
  const bool jumped = step < 0 || step > kFarthest;
  const std::int64_t skipped = jumped ? 0 : std::max<std::int64_t>(0, step - 1);
  numbers.lost += skipped;
  counts_.lost += skipped;
  numbers.last = seq;
  numbers.late = 0;

  // Numbers that jump again and again come from several senders, or are no count.
  constexpr int kClose = 10, kMostJumps = 3;
  if (!jumped) return;
  numbers.jumps = numbers.since_jump <= kClose ? numbers.jumps + 1 : 1;
  numbers.since_jump = 0;
  if (numbers.jumps <= kMostJumps) return;
  counts_.lost -= std::exchange(numbers.lost, 0);
  numbers.counts = false;
}

SourceEvent LcmLiveSource::next(std::chrono::milliseconds patience) {
  // Deliver what is already waiting.
  if (!to_come_.empty()) return take_next();
  Packet packet;
  {
    // Wait for a message, or for another channel that has to be reported.
    std::unique_lock lock(mutex_);
    const auto to_tell = [this] { return !other_.empty() && !told_of_other_; };
    if (!arrived_.wait_for(lock, patience, [&] { return !packets_.empty() || to_tell(); })) {
      if (listener_.broken()) return SourceFailed{{"the LCM connection broke", bus_->url(), "check the network"}};
      return Timeout{};
    }

    // Report once that other channels also carry frames.
    if (to_tell()) {
      told_of_other_ = true;
      return SourceNotice{{"frames also arrive on other channels, among them " + other_ + "; they are ignored",
                           name_of(chosen_), "name the channel if this is the wrong one"}};
    }

    // Take the oldest message; it is decoded after the mutex has been released.
    packet = std::move(packets_.front());
    packets_.pop_front();
  }
  return decode_packet(packet);
}

SourceEvent LcmLiveSource::decode_packet(const Packet& packet) {
  // Decode the message, or report why it is skipped.
  auto frame = decode_frame_message(packet.message, options_.foreign, foreign_number_);
  if (!frame) {
    Error error = frame.error();
    error.where = name_of(packet.channel);
    return SkippedFrame{std::move(error)};
  }

  // Check the order of the frames of this channel, and that they come from one sender.
  choose(packet.channel);
  tell_of_senders(packet.channel, **frame);
  tell_of_jumps(packet.channel);
  FrameOrder& order = orders_.try_emplace(packet.channel, StampUnit::microseconds).first->second;
  const auto number = order.number((*frame)->utime, (*frame)->number);
  for (const std::string& warning : order.take_warnings())
    to_come_.push_back(SourceNotice{{warning, name_of(packet.channel), ""}});
  ++foreign_number_;

  // Deliver the frame, or report why it is skipped.
  if (number) {
    (*frame)->number = *number;
    to_come_.push_back(FramePtr(*std::move(frame)));
  } else {
    to_come_.push_back(SkippedFrame{{number.error().what, name_of(packet.channel), number.error().remedy}});
  }
  return take_next();
}

/// Reports once if several sensors send frames on one channel, since they would be taken for one.
void LcmLiveSource::tell_of_senders(const std::string& channel, const RgbdFrame& frame) {
  const int width = frame.camera.width, height = frame.camera.height;
  const auto [found, is_first] = senders_.try_emplace(channel);
  Sender& first = found->second;
  if (is_first) first = {frame.sensor, width, height};
  const bool same = first.sensor == frame.sensor && first.width == width && first.height == height;
  if (same || !first.alone) return;

  first.alone = false;
  const auto name = [](const std::string& sensor, int w, int h) {
    return (sensor.empty() ? "a sensor" : "sensor " + in_quotes(sensor)) + " of " + std::to_string(w) + "x" +
           std::to_string(h) + " pixels";
  };
  to_come_.push_back(SourceNotice{{"frames of " + name(frame.sensor, width, height) + " come on the channel of " +
                                       name(first.sensor, first.width, first.height),
                                   name_of(channel), "give every sensor a channel of its own"}});
}

/// Reports once if the numbers of a channel do not count its frames.
void LcmLiveSource::tell_of_jumps(const std::string& channel) {
  const std::lock_guard lock(mutex_);
  const auto found = sequences_.find(channel);
  if (found == sequences_.end() || found->second.counts || std::exchange(found->second.told, true)) return;
  to_come_.push_back(SourceNotice{{"the numbers (seq) of the frames jump, so that lost frames are not counted",
                                   name_of(channel), "let one program alone send on the channel, and count up by 1"}});
}

SourceEvent LcmLiveSource::take_next() {
  SourceEvent event = std::move(to_come_.front());
  to_come_.pop_front();
  return event;
}

/// Accepts frames of one channel only, since those of two sensors are not one sequence. Waiting messages of other
/// channels are dropped and no longer count as received.
void LcmLiveSource::choose(const std::string& channel) {
  const std::lock_guard lock(mutex_);
  if (!chosen_.empty()) return;
  chosen_ = channel;
  counts_.received -= static_cast<std::int64_t>(std::erase_if(packets_, [&](const Packet& packet) {
    if (packet.channel == chosen_) return false;
    if (carries_frames(message_hash(packet.message))) other_ = packet.channel;
    return true;
  }));
}

std::vector<QueueHealth> LcmLiveSource::queues() const {
  const std::lock_guard lock(mutex_);
  const auto waiting = static_cast<std::int64_t>(packets_.size());
  const std::int64_t received = counts_.received;
  return {{"transit", 0, 0, received + counts_.lost, received, counts_.lost, {}},
          {"inbox",
           options_.capacity,
           packets_.size(),
           received,
           received - counts_.replaced - waiting,
           counts_.replaced,
           {}}};
}

LcmLiveCounts LcmLiveSource::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace barehand
