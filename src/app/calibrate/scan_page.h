#pragma once

#include <string>

#include "app/calibrate/scan_report.h"
#include "hand/profile.h"
#include "io/web/view_server.h"
#include "io/web/view_status.h"

namespace barehand {

/// What the live page says of a scan. `how_to`: what the user is to do. `start`: the profile that it began with; `now`:
/// as fitted or measured so far.
ViewScan view_scan(const std::string& how_to, const ScanReport& report, const HandProfile& start,
                   const HandProfile& now);

/// Tells the page, where there is one, what becomes of a scan after its last frame.
class ScanPage {
 public:
  /// `server`: null, or outlives this object. `state`: of the last frame, with its scan.
  ScanPage(ViewServer* server, ViewState state) : server_(server), state_(std::move(state)) {}
  void measuring(const std::string& progress) { show(ViewScan::Phase::measuring, progress); }
  /// The last word: it is with every browser that reads when this returns. `result`: null: no profile came of it.
  void done(const std::string& what, const HandProfile* result);

 private:
  void show(ViewScan::Phase phase, const std::string& progress);

  ViewServer* server_;
  ViewState state_;
};

}  // namespace barehand
