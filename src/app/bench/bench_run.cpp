// Runs the cases of `barehand bench` and writes their figures.
#include "app/bench/bench_run.h"

#include <fstream>
#include <iostream>

#include "app/bench/bench_observers.h"
#include "app/bench/bench_report.h"
#include "app/bench/bench_sweep.h"
#include "app/shared/exit_code.h"
#include "app/shared/outputs.h"
#include "app/shared/run_inputs.h"
#include "app/shared/standard_streams.h"
#include "core/memory/available_memory.h"
#include "core/memory/kept_memory.h"
#include "core/parallel/parallel.h"
#include "io/data_files.h"
#include "tracking/memory_check.h"

namespace barehand {
namespace {

/// A case and the name of its configuration.
struct NamedCase {
  std::string config;
  BenchCase bench;
};

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(": ") + 2, line.size()));
  return "unknown";
}

/// All cases to measure: every configuration as it is, then every sweep of the first one.
Result<std::vector<NamedCase>> cases_of(const BenchOptions& options) {
  if (const auto workers = make_workers(options.threads); !workers) return tl::unexpected(workers.error());

  // Add the configurations as they are.
  std::vector<NamedCase> cases;
  for (const std::string& name : options.configs) {
    auto config = read_configuration(name);
    if (!config) return tl::unexpected(config.error());
    cases.push_back({name, {"", 0, std::move(*config), options.threads, 1}});
  }

  // Add the sweeps of the first configuration.
  const NamedCase base = cases.front();
  for (const std::string& sweep : options.sweeps) {
    auto swept = parse_sweep(sweep, base.bench);
    if (!swept) return tl::unexpected(swept.error());
    for (BenchCase& bench : *swept) cases.push_back({base.config, std::move(bench)});
  }

  // Check that no case needs more memory than there is.
  for (const NamedCase& named : cases)
    if (const auto fits = check_memory(named.bench.config.tracker, available_memory()); !fits)
      return tl::unexpected(fits.error());
  return cases;
}

/// What all cases use.
struct Input {
  FrameStore store;
  BenchScene scene;
};

Result<Input> read_input(const BenchOptions& options) {
  const SystemClock clock;
  SourceRequest request;
  request.spec = options.source;
  auto source = open_source(request, clock);
  if (!source) return tl::unexpected(source.error());
  if (source->source->live()) return fail("is a live source", options.source, "give folder:DIR, log:FILE or sim:NAME");
  auto hands = choose_hands(options.hands, *source);
  if (!hands) return tl::unexpected(hands.error());
  auto objects = load_objects(options.objects, *make_logger());
  if (!objects) return tl::unexpected(objects.error());
  std::cerr << "reading frames of " << source->source->name() << "\n";
  auto store = read_frames(*source->source, options.store);
  if (!store) return tl::unexpected(store.error());
  return Input{std::move(*store), {profiles_of(*hands), std::move(*objects)}};
}

/// Checks that the files to be written may be written and are not read as well. The plots are those that are always
/// drawn, and one for each sweep.
Result<void> check_written(const BenchOptions& options) {
  std::vector<InputFile> inputs{{"--draw", options.draw}};
  for (const std::string& config : options.configs) inputs.push_back({"--config", find_config(config).value_or("")});
  for (const std::string& path : profile_paths(options.hands)) inputs.push_back({"--hand", path});

  for (const std::string& object : options.objects.paths) inputs.push_back({"--object", object});
  const bool draws = !options.draw.empty() || (!options.json.empty() && !options.plots.empty());
  const std::string folder = options.plots.empty() ? "." : options.plots;
  std::vector<std::string> plots = {"stages", "memory"};
  for (const std::string& sweep : options.sweeps) plots.push_back(sweep.substr(0, sweep.find('=')));

  // Compare them, and the file of figures, with the files that are read.
  std::vector<Output> outputs{{"--json", options.draw.empty() ? options.json : ""}};
  for (const std::string& plot : plots)
    if (draws) outputs.push_back({"--plots", folder + "/" + plot + ".png"});
  return check_outputs(options.draw.empty() ? files_of_source(options.source) : SourceFiles(), inputs, outputs,
                       options.overwrite);
}

Result<BenchRow> measure(const NamedCase& named, const BenchConditions& conditions, const Input& input) {
  const FrameStore store = decimated(input.store, named.bench.decimate);
  auto result = run_case(named.bench, conditions, store, input.scene);
  if (!result) return tl::unexpected(result.error());
  const Intrinsics& camera = store.frames[0]->camera;
  return BenchRow{named.bench.sweep, named.bench.value, named.config,      named.bench.threads,
                  camera.width,      camera.height,     std::move(*result)};
}

/// Measures all cases, prints their figures and adds them to the report. Ends early if the figures are only printed and
/// the reader of the output has gone.
Result<void> measure_all(const std::vector<NamedCase>& cases, const Input& input, const BenchOptions& options,
                         BenchReport& report, std::ostream& told) {
  for (int round = 0; round < options.repeat; ++round)  // repeats all cases in turn: other load affects all of them
    for (const NamedCase& named : cases) {
      if (options.json.empty() && output_is_closed()) return {};
      auto row = measure(named, report.conditions, input);
      if (!row) return tl::unexpected(row.error());
      told << bench_text(*row) << std::flush;
      report.rows.push_back(std::move(*row));
    }
  return {};
}

/// Compares samples on the CPU and on a graphics device, if there is one. Call it after all cases are measured, since
/// the memory of the device's driver would count as theirs.
void measure_observers(const std::vector<NamedCase>& cases, BenchReport& report, std::ostream& told) {
  for (const NamedCase& named : cases) {
    if (!named.bench.sweep.empty()) continue;
    auto rows = compare_observers(named.config, named.bench.config, named.bench.threads);
    if (!rows) {
      told << "samples are compared on the CPU alone: " << rows.error().message() << "\n";
      return;
    }
    for (ObserverRow& row : *rows) {
      told << bench_text(row) << std::flush;
      report.observers.push_back(std::move(row));
    }
  }
}

}  // namespace

int run_bench(const BenchOptions& options) {
  if (const auto free = check_written(options); !free) return failed("bench", free.error(), kExitUsage);
  if (!options.draw.empty()) {
    const auto drawn = draw_bench(options.draw, options.plots.empty() ? "." : options.plots);
    return drawn ? kExitOk : failed("bench", drawn.error(), kExitUsage);
  }

  // Check everything before the measurement starts.
  keep_freed_memory();  // as `track` does
  const auto cases = cases_of(options);
  if (!cases) return failed("bench", cases.error(), kExitUsage);
  const auto input = read_input(options);
  if (!input) return failed("bench", input.error(), kExitUsage);

  // Measure, and write the report with the conditions of the measurement.
  BenchReport report;
  report.source = options.source;
  report.processor = processor_name();
  report.cores = available_cores();
  report.hands = static_cast<int>(input->scene.hands.size());
  report.conditions = {options.frames, options.warm_up, options.rate, options.single_threaded, options.lcm_url};

  // The table goes to the standard output, unless the figures do.
  std::ostream& told = is_standard_output(options.json) ? std::cerr : std::cout;
  auto done = measure_all(*cases, *input, options, report, told);
  if (done) measure_observers(*cases, report, told);
  if (done && !options.json.empty()) done = write_bench_json(report, options.json);
  if (done && !options.json.empty() && !options.plots.empty()) done = draw_bench(options.json, options.plots);
  if (!done) return failed("bench", done.error(), kExitFailure);
  return options.json.empty() ? printed(kExitOk) : static_cast<int>(kExitOk);
}

}  // namespace barehand
