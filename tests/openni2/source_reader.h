#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sensor/frame_source.h"

namespace barehand {

/// Reads a source as the pipeline does, and keeps the notices.
class SourceReader {
 public:
  explicit SourceReader(FrameSource& source) : source_(source) {}

  /// The next frame for which `wanted` is true; null: none arrived in time.
  FramePtr frame(const std::function<bool(const RgbdFrame&)>& wanted = [](const RgbdFrame&) { return true; }) {
    FramePtr found;
    read_until([&] { return last_ && wanted(*last_); }, kGoodTime, [&] { found = last_; });
    return found;
  }
  std::vector<FramePtr> frames(int count) {
    std::vector<FramePtr> all;
    for (int i = 0; i < count; ++i)
      if (FramePtr next = frame()) all.push_back(std::move(next));
    return all;
  }
  /// Reads until a notice contains `text`; false: none did in time.
  bool told(const std::string& text) {
    return read_until([&] { return notices.find(text) != std::string::npos; }, kGoodTime, [] {});
  }
  /// Reads for this time; returns the number of frames that arrived.
  int frames_within(std::chrono::milliseconds time) {
    const int before = delivered;
    read_until([] { return false; }, time, [] {});
    return delivered - before;
  }

  std::string notices;  ///< one per line; may be cleared
  int delivered = 0, skipped = 0;
  bool ended = false;
  std::optional<Error> failed;

 private:
  static constexpr std::chrono::seconds kGoodTime{30};

  template <class Condition, class Then>
  bool read_until(Condition condition, std::chrono::milliseconds limit, Then then) {
    const auto deadline = std::chrono::steady_clock::now() + limit;
    while (std::chrono::steady_clock::now() < deadline && !ended) {
      if (!read()) continue;
      if (condition()) return then(), true;
    }
    return false;
  }
  /// Reads the next event; false if none arrived.
  bool read() {
    SourceEvent event = source_.next(std::chrono::milliseconds(20));
    last_ = nullptr;
    if (auto* frame = std::get_if<FramePtr>(&event)) last_ = *frame, ++delivered;
    if (const auto* notice = std::get_if<SourceNotice>(&event)) notices += notice->error.message() + "\n";
    if (std::holds_alternative<SkippedFrame>(event)) ++skipped;
    if (const auto* failure = std::get_if<SourceFailed>(&event)) failed = failure->error;
    ended = failed || std::holds_alternative<EndOfStream>(event);
    return !std::holds_alternative<Timeout>(event);
  }

  FrameSource& source_;
  FramePtr last_;
};

}  // namespace barehand
