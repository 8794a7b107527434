// The command `barehand convert`, which copies a recording to another format.
#include "app/record/convert_command.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/record/run_copy.h"
#include "app/shared/exit_code.h"
#include "io/lcm/log_names.h"

namespace barehand {
namespace fs = std::filesystem;
namespace {

/// Whether the path is a recording folder rather than a folder of logs. A recording may also contain files that end in
/// .log.
bool is_recording(const fs::path& path) {
  std::error_code ignored;  // a path without access is reported when it is opened
  if (!fs::is_directory(path, ignored)) return false;
  return fs::exists(path / "depth.txt", ignored) || fs::exists(path / "camera.json", ignored) || !find_logs(path);
}

int convert(const std::string& in, CopyRequest request) {
  const bool oni = fs::path(in).extension() == ".oni";
  request.source.spec = (is_recording(in) ? "folder:" : oni ? "openni2:" : "log:") + in;
  return run_copy(request, "barehand convert");
}

}  // namespace

void add_convert_command(CLI::App& app, int& exit_code) {
  auto request = std::make_shared<CopyRequest>();
  request->out_option = "out";
  auto in = std::make_shared<std::string>();

  // Add options for the input and the output, then those that the command shares with record.
  CLI::App* command = app.add_subcommand(
      "convert", "Turn recordings into one another: folder, LCM log, MCAP file; and .oni files into any of them");
  command
      ->add_option("in", *in,
                   "recording folder, LCM log, folder or set of logs, MCAP file or bag of ROS 2, or .oni file")
      ->required();
  command->add_option("out", request->out, "FILE.lcmlog, FILE.mcap, or a folder to create")->required();
  add_copy_options(*command, *request);

  // State what is kept of the original.
  command->footer(
      "Time stamps are kept; logs and MCAP files keep frame numbers too, a folder numbers its frames from 0. hand.json "
      "and "
      "truth.csv stay beside the original. The times of an .oni file count from 1 s.");
  command->callback([request, in, &exit_code] { exit_code = convert(*in, *request); });
}

}  // namespace barehand
