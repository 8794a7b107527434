// The command `barehand track`: its options and their conversion to a run.
#include "app/track/track_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "app/shared/outputs.h"
#include "app/track/track_options.h"
#include "app/track/track_run.h"
#include "core/parallel/parallel.h"
#include "io/web/allowed_origin.h"

namespace barehand {

void add_input_options(CLI::App& command, TrackOptions& o) {
  command.add_option("--source", o.source,
                     "folder:DIR | log:FILE (LCM or MCAP) | lcm | openni2[:SENSOR|:FILE.oni] | sim:NAME");
  command
      .add_option("--config", o.config,
                  "a file, paper.yaml, default.yaml, accurate.yaml, or builtin (the values in the code)")
      ->capture_default_str();

  // Add options for which hands are tracked.
  command
      .add_option("--hand", o.hands,
                  "hand.json, or right, left, both: the shipped mean adult hand; twice for a right and a left hand "
                  "(their files become OUT.csv and OUT_left.csv); default: the recording's own, else right")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);

  // Add options for which frames are tracked, and from which pose.
  command.add_option("--start", o.start, "first frame of a recording; when playing backwards, from there down to 0");
  command.add_option("--step", o.step, "every N-th frame; negative plays backwards")->capture_default_str();
  command.add_option("--init", o.init, "first pose: auto (found in the image) or pose.json")->capture_default_str();
}

void add_origin_option(CLI::App& command, const std::string& name, std::vector<std::string>& origins) {
  command.add_option(name, origins, "origin of another web page that may connect, such as https://example.org")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(wrong_origin);
}

void add_view_options(CLI::App& command, TrackOptions& o) {
  command
      .add_option("--view", o.view,
                  "serve a page that shows the tracked hand, at this PORT or ADDRESS:PORT (0.0.0.0:8765: to the whole "
                  "network); without one at http://localhost:8765")
      ->expected(0, 1)
      ->default_str("8765")
      ->type_name("[PORT]");

  // Add options for what the page may do.
  add_origin_option(command, "--view-origin", o.view_origins);
  command.add_option(
      "--view-record", o.view_record,
      "folder into which the page's button records, as LCM logs named by their time; default: it records "
      "nothing");
}

void add_track_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<TrackOptions>();
  TrackOptions& o = *options;
  o.threads = available_cores();
  CLI::App* track = app.add_subcommand("track", "Track a hand in a recording, a log, live frames or the simulator");
  add_input_options(*track, o);
  add_object_options(*track, o.objects);

  // Add options for the files that are written.
  track->add_option("--result", o.result, "write the table of segment poses (CSV)");
  track->add_option("--states-log", o.states_log, "write the published states to an LCM log");
  track->add_option("--mcap", o.mcap,
                    "write images and hands as ROS 2 messages to an MCAP file, for Foxglove, ROS and replay");
  track->add_option("--log-decisions", o.decisions,
                    "write every decision of the tracker with the rule that made it (CSV)");

  // Add options for the images with the hand drawn over them.
  track->add_option("--overlay", o.overlay,
                    "draw the tracked hand over the images: into a folder, or a video (.mp4, .mkv, .webm, .avi)");
  track->add_flag("--overlay-names", o.overlay_names, "write the names of the segments beside the drawn hand")
      ->needs("--overlay");
  track->add_option("--save-hand", o.save_hand, "write the hand profile as fitted to the person (hand.json)");
  track->add_option("--overlay-every", o.overlay_every, "draw every N-th frame only")
      ->check(CLI::Range(1, 1'000'000'000))
      ->capture_default_str();
  add_overwrite_option(*track, o.overwrite);

  // Add options for the network, and for how the run is computed.
  track->add_option("--lcm-url", o.lcm_url, "LCM network of the source lcm and of what is published");
  track->add_option("--threads", o.threads, "cores to use; results do not depend on it")->capture_default_str();
  track->add_option("--seed", o.seed, "seed of the random numbers, instead of the configuration's");
  track->add_flag("--inline", o.single_threaded, "run all stages on one thread, for debugging; same results");
  track->add_flag("--no-publish", o.no_publish, "send nothing on LCM");
  track->add_flag("--health", o.health, "print the state of the pipeline every health period");

  // Add options for what the run shows.
  add_view_options(*track, o);
  track
      ->add_flag("--print-config{user}", o.print_config,
                 "print the configuration in force and stop: the keys for users, =all for every key, =changed for what "
                 "differs from the defaults")
      ->check(CLI::IsMember({"user", "all", "changed"}));

  // Explain how a run ends, and what happens to existing files.
  track->footer(
      "Ctrl-C ends the run; everything tracked until then is written. Files get their names when they are complete; "
      "until then, and after a crash, they are called NAME.unfinished. A live run does not fail if a file exists: it "
      "writes NAME-2, NAME-3 and so on.\n"
      "The exit code is 1, too, if no frame of a recording could be read, or if more than half of them could not.");
  track->callback([options, &exit_code] { exit_code = run_track(*options); });
}

}  // namespace barehand
