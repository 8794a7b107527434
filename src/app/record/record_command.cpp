// The command `barehand record`, which writes the frames of any source to a file or folder.
#include "app/record/record_command.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "app/record/run_copy.h"

namespace barehand {
namespace {

constexpr std::int64_t kLargestSize = std::int64_t{1} << 62;  // [bytes]
constexpr double kLongestAge = 1e9;                           // [s]

}  // namespace

void add_record_command(CLI::App& app, int& exit_code) {
  auto request = std::make_shared<CopyRequest>();
  request->source.live_capacity = 128;  // number of frames in a few seconds, since a recording should lose none

  // Add options for the input, the output and the duration.
  CLI::App* record = app.add_subcommand("record", "Record frames into an LCM log, an MCAP file or a folder");
  record
      ->add_option("--source", request->source.spec,
                   "openni2[:SENSOR] | lcm | sim:NAME | folder:DIR | log:FILE (LCM or MCAP)")
      ->required();
  record->add_option("--out", request->out, "FILE.lcmlog, FILE.mcap, or a folder to create")->required();
  record->add_option("--seconds", request->seconds, "stop after this time")->check(CLI::PositiveNumber);
  record->add_option("--lcm-url", request->source.lcm_url, "LCM network of the source lcm");

  // Add options for the limits at which a recording continues in a new log.
  record->add_option("--max-size", request->max_size, "continue in a new log at this size, such as 2GB")
      ->transform(CLI::AsSizeValue(true))
      ->check(CLI::Range(std::int64_t{1}, kLargestSize));
  record->add_option("--max-age", request->max_age, "continue in a new log after this time, such as 10min or 1h")
      ->transform(
          CLI::AsNumberWithUnit(std::map<std::string, double>{{"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}}))
      ->check(CLI::Range(1.0, kLongestAge));
  record
      ->add_option("--quota", request->quota, "limit of all these logs together, such as 100GB; the oldest are removed")
      ->transform(CLI::AsSizeValue(true))
      ->check(CLI::Range(std::int64_t{1}, kLargestSize));

  // Add the options that this command shares with convert.
  add_copy_options(*record, *request);

  // State what happens at the end of the recording, and when the disk is full.
  record->footer(
      "Ctrl-C ends the recording; the recording until then is complete, as it is after a crash, but for the last "
      "frames of an MCAP file. While the disk "
      "is full, frames of a live source are lost and counted.\n"
      "With --max-size, --max-age or --quota, take.lcmlog becomes take-000001-TIME.lcmlog and so on, each complete in "
      "itself and counted on from those that are there. With a quota the oldest are also removed when the disk is "
      "full.");
  record->callback([request, &exit_code] { exit_code = run_copy(*request, "barehand record"); });
}

}  // namespace barehand
