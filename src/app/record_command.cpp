#include "app/record_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "app/run_copy.h"

namespace barehand {

void add_record_command(CLI::App& app, int& exit_code) {
  auto request = std::make_shared<CopyRequest>();
  request->source.live_capacity = 128;  // a few seconds: a recording is to miss nothing
  CLI::App* record = app.add_subcommand("record", "Record frames into an LCM log or a folder");
  record->add_option("--source", request->source.spec, "lcm | sim:NAME | folder:DIR | log:FILE")->required();
  record->add_option("--out", request->out, "FILE.lcmlog, or a folder that is made")->required();
  record->add_option("--seconds", request->seconds, "stop after this time")->check(CLI::PositiveNumber);
  record->add_option("--lcm-url", request->source.lcm_url, "LCM network of the source lcm");
  add_copy_options(*record, *request);
  record->footer("Ctrl-C ends the recording; what was recorded until then is complete. So does a full disk.");
  record->callback([request, &exit_code] { exit_code = run_copy(*request, "barehand record"); });
}

}  // namespace barehand
