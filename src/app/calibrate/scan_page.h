#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "app/calibrate/scan_report.h"
#include "hand/profile.h"
#include "io/web/view_server.h"
#include "io/web/view_status.h"

namespace barehand {

/// The state of a scan as the live page shows it. `how_to`: instructions for the user. `start`: the profile that the
/// scan began with; `now`: the profile as fitted or measured so far.
ViewScan view_scan(const std::string& how_to, const ScanReport& report, const HandProfile& start,
                   const HandProfile& now);

/// Shows on the live page, if there is one, how a scan continues after its last frame. The state is sent again and
/// again, since measuring says something new only every few seconds, and browsers take silence for a lost connection.
class ScanPage {
 public:
  /// `server`: null if there is no page; otherwise it must outlive this object. `state`: state of the page at the last
  /// frame, with its scan.
  ScanPage(ViewServer* server, ViewState state);
  /// Shows how the measuring goes. The first call returns when every browser that reads has received it.
  void measuring(const std::string& progress) { show(ViewScan::Phase::measuring, progress); }
  /// Shows the end of the scan; when it returns, every browser that reads has received it. `result`: the measured
  /// profile; null: there is none.
  void done(const std::string& what, const HandProfile* result);

 private:
  void show(ViewScan::Phase phase, const std::string& progress);
  void send();

  ViewServer* server_;
  std::mutex mutex_;  // guards state_
  ViewState state_;
  std::condition_variable_any tick_;
  std::jthread repeat_;  // last, so that it ends first
};

}  // namespace barehand
