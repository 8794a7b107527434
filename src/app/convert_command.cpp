#include "app/convert_command.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/exit_code.h"
#include "app/run_copy.h"

namespace barehand {
namespace {

int convert(const std::string& in, CopyRequest request) {
  const std::filesystem::path path(in);
  const bool oni = path.extension() == ".oni";
  std::error_code ignored;  // what cannot be looked at shows when it is opened
  request.source.spec = (std::filesystem::is_directory(path, ignored) ? "folder:" : oni ? "openni2:" : "log:") + in;
  return run_copy(request, "barehand convert");
}

}  // namespace

void add_convert_command(CLI::App& app, int& exit_code) {
  auto request = std::make_shared<CopyRequest>();
  request->out_option = "out";
  auto in = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "convert", "Turn a recording folder or an .oni file into an LCM log, or a log or .oni file into a folder");
  command->add_option("in", *in, "folder, LCM log or .oni file")->required();
  command->add_option("out", request->out, "FILE.lcmlog, or a folder that is made")->required();
  add_copy_options(*command, *request);
  command->footer(
      "Time stamps are kept; a log keeps frame numbers too, a folder numbers its frames from 0. hand.json and "
      "truth.csv stay beside the original. The times of an .oni file count from 1 s.");
  command->callback([request, in, &exit_code] { exit_code = convert(*in, *request); });
}

}  // namespace barehand
