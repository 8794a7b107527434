// The command `barehand experiment`, which repeats the paper's experiments on the simulator.
#include "app/experiment/experiment_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/experiment/experiment_run.h"
#include "app/shared/standard_streams.h"
#include "core/parallel/parallel.h"

namespace barehand {
namespace {

struct ExperimentArguments {
  std::string name;
  std::vector<std::string> configs;
  std::string init = "truth";
  ExperimentOptions options;
};

int run(const ExperimentArguments& a) {
  const auto plan = plan_experiment(a.name, a.configs);
  if (!plan) return failed("experiment", plan.error(), kExitUsage);
  const auto report = run_experiment(*plan, a.options);
  if (!report) return failed("experiment", report.error().error, report.error().exit_code);
  std::cout << experiment_table(*report) << std::flush;
  return kExitOk;
}

}  // namespace

void add_experiment_command(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<ExperimentArguments>();
  ExperimentOptions& o = a->options;
  o.threads = available_cores();
  CLI::App* command = app.add_subcommand("experiment", "Repeat the paper's experiments with the simulator");

  // Add the name of the experiment.
  command
      ->add_option("name", a->name,
                   "fist (Fig. 6a), occlusion (seven levels, Fig. 6b-c and 7), grasp (mug, ball and pliers, Fig. 8) or "
                   "ablation (the effect of each addition to the paper's method)")
      ->required()
      ->check(CLI::IsMember(experiment_names()));

  // Add options for where the results go, and what is compared.
  command->add_option("--out", o.out, "folder to create: recordings, results, snapshots, plots and figures")
      ->required();
  command
      ->add_option("--configs", a->configs,
                   "configurations side by side, as for track --config; default: paper,default; ablation: default")
      ->delimiter(',')
      ->allow_extra_args(false);

  // Add options for the simulated sequence.
  command
      ->add_option("--set", o.keys,
                   "key=value of the simulator (sim --list), may be repeated: noise=kinect; another hand is scale=1.1, "
                   "thickness=1.15 or middle=1.1")
      ->allow_extra_args(false);

  command->add_flag("--overwrite", o.overwrite, "replace an earlier experiment in this folder; other files stay");

  // Add options for how the hand is tracked.
  command->add_option("--hand", o.hand, "hand.json for the tracker; default: measured on the simulated hand");
  command->add_option("--init", a->init, "first pose: truth, or auto (found in the image)")
      ->check(CLI::IsMember({"truth", "auto"}))
      ->capture_default_str();
  command->add_option("--frames", o.frames, "maximum number of frames per sequence")
      ->check(CLI::Range(1, 1'000'000'000));
  command->add_option("--threads", o.threads, "cores to use; results do not depend on it")->capture_default_str();
  command->footer("Ctrl-C ends the run; what was finished until then stays.");

  // The default configurations depend on the experiment.
  command->callback([a, &exit_code] {
    if (a->configs.empty())
      a->configs =
          a->name == "ablation" ? std::vector<std::string>{"default"} : std::vector<std::string>{"paper", "default"};
    a->options.search_start = a->init == "auto";
    exit_code = run(*a);
  });
}

}  // namespace barehand
