// The command `barehand bench`: its options.
#include "app/bench/bench_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "app/bench/bench_options.h"
#include "app/bench/bench_run.h"
#include "app/bench/bench_sweep.h"
#include "app/shared/outputs.h"
#include "core/parallel/parallel.h"

namespace barehand {

void add_bench_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<BenchOptions>();
  BenchOptions& o = *options;
  o.threads = available_cores();
  CLI::App* bench = app.add_subcommand("bench", "Measure speed, latency and memory of track, over frames in memory");

  // Add options for what is tracked, and how.
  bench->add_option("--source", o.source, "folder:DIR | log:FILE | sim:NAME")->capture_default_str();
  bench->add_option("--config", o.configs, "one or more configurations, measured in turn")->capture_default_str();
  bench->add_option("--hand", o.hands, "hand.json, or right, left, both: the shipped mean adult hand; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);

  add_object_options(*bench, o.objects);

  // Add options for the frames that are used.
  bench->add_option("--store", o.store, "frames to keep in memory; they are played back and forth")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  bench->add_option("--frames", o.frames, "number of frames to measure")
      ->check(CLI::Range(1, 100000000))
      ->capture_default_str();
  bench->add_option("--warm-up", o.warm_up, "number of frames before the measured ones")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();

  // Add options for how the pipeline runs.
  bench->add_option("--rate", o.rate, "frames per second of a live sensor; default: as fast as possible")
      ->check(CLI::Range(0.1, 10000.0));
  bench->add_option("--threads", o.threads, "cores to use")->capture_default_str();
  bench->add_flag("--inline", o.single_threaded, "run all stages on one thread");
  bench->add_option("--repeat", o.repeat, "number of times that all cases are measured, in turn")
      ->check(CLI::Range(1, 1000));

  // Add options for what is varied, and where the results go.
  bench->add_option("--sweep", o.sweeps, "vary one parameter: NAME=VALUE,VALUE... (" + sweep_names() + ")");
  bench->add_option("--lcm-url", o.lcm_url, "LCM network of the states")->capture_default_str();
  bench->add_option("--json", o.json, "file for the figures");
  bench->add_option("--plots", o.plots, "folder for plots (PNG) of the figures of --json or --draw");
  bench->add_option("--draw", o.draw, "only draw the plots of this file of figures");
  add_overwrite_option(*bench, o.overwrite);
  bench->footer("Frames are read or rendered before the clock starts.");
  bench->callback([options, &exit_code] { exit_code = run_bench(*options); });
}

}  // namespace barehand
