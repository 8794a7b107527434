// Shows the state of a scan of the hand on the live page.
#include "app/calibrate/scan_page.h"

#include <chrono>

namespace barehand {

ViewScan view_scan(const std::string& how_to, const ScanReport& report, const HandProfile& start,
                   const HandProfile& now) {
  ViewScan scan;
  scan.how_to = how_to;
  scan.missing = report.missing();
  scan.frames = report.frames();
  scan.enough_frames = ScanReport::kEnoughFrames;
  scan.enough_bending = ScanReport::kEnoughBending;

  // Add what was seen of each segment.
  for (int s = 0; s < kSegmentCount; ++s) {
    const ScannedSegment& seen = report.segment(s);
    scan.segments.push_back({std::string(kSegmentNames[s]), seen.palm_side, seen.back_side,
                             seen.most_bent - seen.least_bent, ScanReport::asks_to_bend(s), start.segments[s].length,
                             now.segments[s].length});
  }
  return scan;
}

ScanPage::ScanPage(ViewServer* server, ViewState state) : server_(server), state_(std::move(state)) {
  if (!server_) return;
  static constexpr std::chrono::milliseconds kPause{400};  // docs/view_protocol.md promises two a second
  repeat_ = std::jthread([this](const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      tick_.wait_for(lock, stop, kPause, [] { return false; });
      if (!stop.stop_requested()) send();
    }
  });
}

void ScanPage::done(const std::string& what, const HandProfile* result) {
  {
    const std::lock_guard lock(mutex_);
    for (int s = 0; s < kSegmentCount; ++s) {
      ViewScanSegment& segment = state_.scan->segments[s];
      segment.after = result ? result->segments[s].length : segment.before;
    }
  }
  show(ViewScan::Phase::done, what);
  if (server_) server_->set_farewell({Farewell::kDone, "The calibration is done and the program has ended."});
}

void ScanPage::show(ViewScan::Phase phase, const std::string& progress) {
  if (!server_) return;
  bool begins = false;
  {
    const std::lock_guard lock(mutex_);
    begins = phase != state_.scan->phase;
    state_.scan->phase = phase;
    state_.scan->progress = progress;
    send();
  }

  // A newer status replaces one that waits, so the first one of a phase is waited for: no browser misses a short phase.
  constexpr std::chrono::seconds kPatience{1};
  if (begins) server_->flush(kPatience);
}

void ScanPage::send() {
  state_.clients = server_->clients();
  server_->show_status(status_json(state_));
}

}  // namespace barehand
