// The command line of `barehand`: calls the subcommand and returns its exit code.
#include "app/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <opencv2/core/utility.hpp>

#include "app/bench/bench_command.h"
#include "app/calibrate/calibrate_command.h"
#include "app/doctor/doctor_command.h"
#include "app/eval/eval_command.h"
#include "app/experiment/experiment_command.h"
#include "app/listen/listen_command.h"
#include "app/record/convert_command.h"
#include "app/record/record_command.h"
#include "app/scan/scan_command.h"
#include "app/shared/exit_code.h"
#include "app/shared/standard_streams.h"
#include "app/sim/sim_command.h"
#include "app/track/track_command.h"
#include "app/view/view_command.h"

namespace barehand {
namespace {

/// Refuses empty values: they come of variables that a script does not set, and would mean the root folder or nothing.
void refuse_empty_values(CLI::App& app) {
  constexpr std::array kMayBeEmpty = {"--source", "--prefix", "--lcm-url", "--channel"};
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
    for (CLI::Option* option : command->get_options()) {
      if (option->get_expected_min() == 0 || std::ranges::count(kMayBeEmpty, option->get_name()) > 0) continue;
      option->check(
          [](const std::string& value) { return value.empty() ? "is empty: give a value, or leave it out" : ""; });
    }
}

}  // namespace

int run_program(int argc, char** argv) {
  prepare_standard_streams();

  // Describe what concerns the program as a whole; each command describes itself.
  CLI::App app("Tracks a bare hand that handles objects, and publishes glove-like hand states over LCM.", "barehand");
  app.set_version_flag("--version", BAREHAND_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 failed while running or too few frames could be read, 2 wrong arguments, configuration or "
      "files, 130 interrupted, 141 the reader of the output has gone.\n"
      "barehand COMMAND --help says more.");
  cv::setNumThreads(1);  // prevents OpenCV from starting threads of its own in addition to those of Workers

  // Add the commands; the one that runs sets the exit code.
  int exit_code = kExitOk;
  add_track_command(app, exit_code);
  add_sim_command(app, exit_code);
  add_record_command(app, exit_code);
  add_convert_command(app, exit_code);
  add_eval_command(app, exit_code);
  add_calibrate_command(app, exit_code);

  add_scan_command(app, exit_code);
  add_experiment_command(app, exit_code);
  add_listen_command(app, exit_code);
  add_view_command(app, exit_code);
  add_bench_command(app, exit_code);
  add_doctor_command(app, exit_code);

  refuse_empty_values(app);

  // Run the command. No exception may leave the program without a message.
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? printed(kExitOk) : kExitUsage;
  } catch (const std::exception& error) {  // out of memory, or another failure that no code handles
    std::cerr << "barehand: failed: " << error.what() << std::endl;
    return kExitFailure;
  }
  return exit_code;
}

}  // namespace barehand
