// The command `barehand calibrate`, which measures the profile of a user's hand.
#include "app/calibrate/calibrate_command.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <stop_token>

#include "app/calibrate/scan_page.h"
#include "app/calibrate/scan_report.h"
#include "app/shared/interrupt.h"
#include "app/shared/outputs.h"
#include "app/shared/run_inputs.h"
#include "app/shared/standard_streams.h"
#include "app/track/track_command.h"
#include "app/track/track_run.h"
#include "core/format.h"
#include "core/parallel/parallel.h"
#include "io/atomic_file.h"
#include "io/hand/hand_json.h"
#include "io/place.h"
#include "math/angles.h"
#include "person/scan_frames.h"

namespace barehand {
namespace {

constexpr const char* kHowTo =
    "Open the hand and turn it slowly to show palm and back. Then circle the thumb and bend its joints one by one,\n"
    "make a hook (only the last two joints of the fingers bent), a table top (only the knuckles) and a fist, palm and\n"
    "back towards the camera; half a minute. Ctrl-C ends a live scan; the frames until then are used.";

struct CalibrateOptions {
  TrackOptions track;
  std::string hand = "right", out;
};

constexpr int kSettling = 60;                 // number of tracked frames before the first one that is kept
constexpr int kMost = 128, kMostOfSkin = 64;  // largest numbers of frames that are kept; kMostOfSkin with fixed joints

/// Collects the data for a scan, which are the latest fitted hand and a selection of frames, and tells the user which
/// views of the hand are still missing.
class ScanSink : public Sink {
 public:
  // What was collected so far.
  struct Scan {
    ScanReport report;
    ScanFrames frames;
    std::shared_ptr<const HandProfile> profile;  ///< null: no hand was tracked
  };
  explicit ScanSink(Scan& scan) : scan_(scan) {}
  std::string name() const override { return "scan"; }
  Result<void> consume(const TrackedFrame& tracked) override {
    const HandEstimate& hand = *tracked.estimates[0];
    scan_.report.add(hand);
    scan_.frames.add(tracked.observations[0], hand);
    if (hand.has_pose()) scan_.profile = hand.profile;
    advise();
    return {};
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kAdvise{4};  // time between two instructions to the user

  // Tells the user from time to time what is still missing.
  void advise() {
    if (complete_ || Clock::now() < advised_ + kAdvise) return;
    const auto missing = scan_.report.missing();
    complete_ = missing.empty();
    std::cerr << "\n"
              << (complete_ ? "every part of the hand was seen; Ctrl-C ends a live scan" : missing.front())
              << std::endl;
    advised_ = Clock::now();
  }

  Scan& scan_;
  bool complete_ = false;
  Clock::time_point advised_ = Clock::now();
};

/// Prints the fitted bones, and what was seen of each of them.
void print(std::FILE* out, const ScanReport& report, const HandProfile& start, const HandProfile& fitted) {
  std::fprintf(out, "%-20s %11s %11s %12s %12s %12s\n", "segment", "length [mm]", "before [mm]", "palm side", "back",
               "bent [deg]");
  for (int s = 0; s < kSegmentCount; ++s) {
    const ScannedSegment& seen = report.segment(s);
    std::fprintf(out, "%-20s %11.1f %11.1f %12d %12d %5.0f to %3.0f\n", std::string(kSegmentNames[s]).c_str(),
                 fitted.segments[s].length * 1e3, start.segments[s].length * 1e3, seen.palm_side, seen.back_side,
                 seen.least_bent / kDegree, seen.most_bent / kDegree);
  }
  std::fprintf(out, "%d frames tracked; hand %.0f mm long, before %.0f mm\n", report.frames(),
               fitted.hand_length() * 1e3, start.hand_length() * 1e3);
  for (const std::string& sentence : report.missing())
    std::fprintf(out, "not seen well enough, so close to the initial hand; to measure it, %s\n", sentence.c_str());
}

/// Scans the skin from the frames that were kept; none if they do not suffice, or `stop` was requested.
std::optional<HandProfile> scanned(std::FILE* out, const ScanSink::Scan& scan, double cell, int threads, ScanPage& page,
                                   const std::stop_token& stop) {
  // Refuse too few frames, which do not determine a skin.
  const int frames = static_cast<int>(scan.frames.frames().size());
  if (frames < ScanFrames::kFewest) {
    std::fputs("the scan was too short to measure the skin\n", out);
    return std::nullopt;
  }

  // Scan, and report the progress.
  Workers workers(threads);
  const auto tell = [&](const ScanProgress& progress) {
    const std::string text = formatted("skin and joints: round %d of %d, mean error before it %.2f mm", progress.round,
                                       progress.rounds, progress.mismatch * 1e3);
    std::fprintf(stderr, "%s\n", text.c_str());
    page.measuring("Measuring " + text + ".");
  };
  const auto hand = scan_hand(*scan.profile, cell, scan.frames.frames(), workers, tell, stop);

  if (hand)
    std::fprintf(out, "skin and joints from %d frames\n", frames);
  else if (stop.stop_requested())
    std::fputs("stopped before the skin was measured; the result is the fitted hand alone\n", stderr);
  else
    std::fputs("the skin cannot be measured in these frames; the result is the fitted hand alone\n", stderr);
  return hand;
}

struct Measured {
  HandProfile hand;
  bool skin = false;  ///< whether the skin was measured, too
};

/// Scans the skin, and saves the scanned profile or, if the scan fails, the fitted one. Error: it cannot be saved.
Result<Measured> measure(std::FILE* out, const CalibrateOptions& o, const ScanSink::Scan& scan, double cell,
                         ScanPage& page, const std::stop_token& stop) {
  // Save the fitted hand before the scan, which takes a while, unless the output is a pipe, which would get both.
  const bool once = target_of(o.out).direct;
  if (!once)
    if (const auto saved = save_profile(*scan.profile, o.out); !saved) return tl::unexpected(saved.error());

  // Scan the skin.
  page.measuring("Measuring the skin and the joints.");
  const auto hand = scanned(out, scan, cell, o.track.threads, page, stop);
  const Measured result{hand ? *hand : *scan.profile, hand.has_value()};
  if (hand || once)
    if (const auto saved = save_profile(result.hand, o.out); !saved) return tl::unexpected(saved.error());
  return result;
}

/// Makes a profile from the frames of the run, saves it, and reports the result. `stop` ends the measuring early, and
/// the fitted hand is the result. Returns the exit code.
int conclude(std::FILE* out, const CalibrateOptions& o, const Config& config, const HandProfile& start,
             const ScanSink::Scan& scan, const TrackOutcome& tracked, const std::stop_token& stop) {
  // Show on the page what was scanned.
  ViewState state;
  state.source = o.track.source;
  state.T_world_camera = world_from(config.world).value_or(std::nullopt);
  state.scan = view_scan(kHowTo, scan.report, start, start);
  ScanPage page(tracked.page ? &tracked.page->server() : nullptr, std::move(state));

  // Report it if no hand was tracked, so that there is nothing to measure.
  if (!scan.profile) {
    page.done("No hand was tracked, so nothing is saved.", nullptr);
    if (tracked.exit_code == kExitFailure) return tracked.exit_code;  // track() has reported why
    return failed("calibrate",
                  {"no hand was tracked, nothing to save", o.track.source, "hold the open hand before the sensor"},
                  kExitFailure);
  }

  const auto result = measure(out, o, scan, config.tracker.skin_cell, page, stop);
  if (!result) {
    page.done("The profile is not saved: " + result.error().message(), nullptr);
    return failed("calibrate", result.error(), kExitFailure);
  }

  // Report the measured profile.
  print(out, scan.report, start, result->hand);
  const char* skin = result->skin            ? ", with a skin of its own"
                     : stop.stop_requested() ? "; stopped before the skin was measured"
                                             : "; the skin could not be measured";
  page.done(formatted("Saved in %s%s. The hand is %.0f mm long, %.0f mm before.", o.out.c_str(), skin,
                      result->hand.hand_length() * 1e3, start.hand_length() * 1e3),
            &result->hand);
  return tracked.stopped ? static_cast<int>(kExitOk) : tracked.exit_code;
}

int run(const CalibrateOptions& o) {
  // Check the input before the user starts to move.
  auto config = read_configuration(o.track.config);
  if (!config) return failed("calibrate", config.error(), kExitUsage);
  config->tracker.shape_fit.enabled = true;
  config->tracker.shape_fit.scans = 0;  // no scans while tracking, since all frames are scanned at the end
  const auto hands = choose_hands({o.hand}, {});
  if (!hands) return failed("calibrate", hands.error(), kExitUsage);
  if (hands->size() != 1)
    return failed("calibrate", {"names two hands", "--hand " + o.hand, "scan one hand after the other"}, kExitUsage);
  if (const auto possible = check_writable(o.out); !possible) return failed("calibrate", possible.error(), kExitUsage);

  // Track, and collect what the user shows.
  const bool joints_stay = hands->front().profile->origin == ProfileOrigin::measured;
  ScanSink::Scan scan{.report = {}, .frames = {kSettling, joints_stay ? kMostOfSkin : kMost}, .profile = nullptr};
  std::vector<std::unique_ptr<Sink>> sinks;
  sinks.push_back(std::make_unique<ScanSink>(scan));

  std::FILE* out = is_standard_output(o.out) || is_standard_output(o.track.overlay) ? stderr : stdout;
  TrackOptions track_options = o.track;
  track_options.hands = {o.hand};
  track_options.saved_later = o.out;
  std::cerr << kHowTo << std::endl;

  // Let the page show what has been measured so far.
  const HandProfile& start = *hands->front().profile;
  const auto shown = [&] { return view_scan(kHowTo, scan.report, start, scan.profile ? *scan.profile : start); };
  hold_interrupts();
  auto tracked = track(track_options, *config, {}, std::move(sinks), shown);
  if (!tracked) return failed("calibrate", tracked.error().error, tracked.error().exit_code);

  // Measure, until a signal comes. It is heard until the page, too, has its last words.
  std::stop_source stop;
  const InterruptWatcher interrupt([&stop] { stop.request_stop(); });
  const int exit_code = conclude(out, o, *config, start, scan, *tracked, stop.get_token());
  tracked->page.reset();
  return exit_code == kExitOk && interrupt.signal() != 0 ? static_cast<int>(kExitInterrupted) : exit_code;
}

}  // namespace

void add_calibrate_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CalibrateOptions>();
  CalibrateOptions& o = *options;
  o.track.no_publish = true;
  o.track.threads = available_cores();

  // Add options for input and output.
  CLI::App* calibrate =
      app.add_subcommand("calibrate", "Measure the profile of the hand that a person shows to the sensor");
  calibrate->add_option("--source", o.track.source, "as for track: openni2, lcm, log:FILE, folder:DIR, sim:scan ...")
      ->required();
  calibrate->add_option("--out", o.out, "hand.json to write")->required();
  calibrate
      ->add_option("--hand", o.hand,
                   "right or left: which hand is shown; or a hand.json, whose joints are kept if it was measured")
      ->capture_default_str();

  // Add options for how the hand is tracked.
  calibrate->add_option("--config", o.track.config, "as for track")->capture_default_str();
  calibrate->add_option("--overlay", o.track.overlay, "as for track, to check the fitted hand");
  add_view_options(*calibrate, o.track);
  add_overwrite_option(*calibrate, o.track.overwrite);
  calibrate->add_option("--lcm-url", o.track.lcm_url, "LCM network of the source lcm");
  calibrate->add_option("--threads", o.track.threads, "cores to use; results do not depend on it")
      ->capture_default_str();
  calibrate->footer(kHowTo);
  calibrate->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace barehand
