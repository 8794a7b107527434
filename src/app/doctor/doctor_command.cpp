// The command `barehand doctor`, which reports what is missing on this machine.
#include "app/doctor/doctor_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/doctor/doctor_checks.h"
#include "app/shared/exit_code.h"
#include "app/shared/standard_streams.h"

namespace barehand {
namespace {

const char* label(Finding::Level level) {
  switch (level) {
    case Finding::Level::ok:
      return "ok      ";
    case Finding::Level::note:
      return "note    ";
    case Finding::Level::warning:
      return "warning ";
    case Finding::Level::problem:
      return "PROBLEM ";
  }
  return "";
}

int run_doctor(const std::string& lcm_url) {
  int problems = 0;
  examine(lcm_url, [&](const Finding& finding) {
    std::cout << label(finding.level) << finding.subject << ": " << finding.text << "\n";
    if (!finding.remedy.empty()) std::cout << "         -> " << finding.remedy << "\n";
    std::cout << std::flush;  // shows this finding now, since the next check may take seconds
    problems += finding.level == Finding::Level::problem;
  });
  std::cout << (problems == 0 ? "Ready to track.\n" : "Not ready: see the lines marked PROBLEM.\n");
  return printed(problems == 0 ? kExitOk : kExitFailure);
}

}  // namespace

void add_doctor_command(CLI::App& app, int& exit_code) {
  auto url = std::make_shared<std::string>();
  CLI::App* doctor = app.add_subcommand("doctor", "Report what this machine lacks for tracking, and how to fix it");
  doctor->add_option("--lcm-url", *url, "LCM network to test; default as for track");
  doctor->callback([url, &exit_code] { exit_code = run_doctor(*url); });
}

}  // namespace barehand
