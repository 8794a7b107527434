// Runs an experiment: renders its sequences, tracks them with every variant and compares the results.
#include "app/experiment/experiment_run.h"

#include <atomic>
#include <filesystem>
#include <iostream>

#include "app/shared/interrupt.h"
#include "app/sim/render_progress.h"
#include "app/sim/sim_run.h"
#include "drivers/synthetic/synthetic_source.h"
#include "io/atomic_file.h"
#include "io/hand/hand_json.h"
#include "io/place.h"

namespace barehand {
namespace {

namespace fs = std::filesystem;
using Step = tl::expected<void, TrackFailure>;

constexpr const char* kMark = "/.experiment";  // file that marks the folder of an experiment
constexpr std::int64_t kSnapshots = 8;         // frames per run that are stored with the tracked hand drawn over them

/// A failure as the result of a step.
tl::unexpected<TrackFailure> stop(const Error& error, int exit_code = kExitFailure) {
  return tl::unexpected(TrackFailure{error, exit_code});
}

/// Mean time of a stage per frame [ms]; 0 if it did not run.
double mean_ms(const PipelineHealth& health, const std::string& stage) {
  for (const StageHealth& s : health.stages)
    if (s.name == stage) return s.time.mean * 1e3;
  return 0;
}

/// The state of a running experiment.
class ExperimentRun {
 public:
  ExperimentRun(const ExperimentPlan& plan, const ExperimentOptions& options) : plan_(plan), options_(options) {}
  tl::expected<ExperimentReport, TrackFailure> run();

 private:
  // Checks the input before anything is written.
  Step check() const;
  // Creates the output folder and marks it as made by an experiment; with `overwrite`, first removes the output of an
  // earlier experiment.
  Step take_folder() const;
  Step make_folders() const;
  // Renders a sequence into a recording; returns its number of frames.
  tl::expected<std::int64_t, TrackFailure> render(const std::string& sequence) const;
  // Tracks and compares a sequence with every variant.
  Step compare(const std::string& sequence);
  // Tracks a sequence with one variant.
  tl::expected<ExperimentRow, TrackFailure> measure(const std::string& sequence, const ExperimentVariant& variant,
                                                    std::int64_t frames);
  std::string spec_of(const std::string& sequence) const;
  std::string recording(const std::string& sequence) const { return options_.out + "/recordings/" + sequence; }

  const ExperimentPlan& plan_;
  const ExperimentOptions& options_;
  ExperimentReport report_;
  std::size_t done_ = 0;
};

tl::expected<ExperimentReport, TrackFailure> ExperimentRun::run() {
  report_.name = plan_.name;
  if (auto ready = check().and_then([&] { return take_folder(); }); !ready) return tl::unexpected(ready.error());
  for (const std::string& sequence : plan_.sequences)
    if (auto compared = compare(sequence); !compared) return tl::unexpected(compared.error());
  if (auto written = write_experiment(report_, options_.out); !written) return stop(written.error());
  return std::move(report_);
}

Step ExperimentRun::check() const {
  // Refuse a folder that contains anything but an experiment that is to be replaced.
  std::error_code error;
  const bool folder = fs::is_directory(options_.out, error);
  const bool replaced = options_.overwrite && folder && fs::exists(options_.out + kMark, error);
  if (fs::exists(options_.out, error) && !replaced && !(folder && fs::is_empty(options_.out, error)))
    return stop({"exists already", options_.out,
                 options_.overwrite ? "it was not created by an experiment: choose another folder or remove it first"
                                    : "choose another folder, or replace an experiment's with --overwrite"},
                kExitUsage);

  // Check the input, and that it is not in the folder to be replaced.
  const SystemClock clock;
  if (const auto source = synthetic::SyntheticSource::open(spec_of(plan_.sequences.front()), clock); !source)
    return stop(source.error(), kExitUsage);
  if (options_.hand.empty()) return {};
  if (replaced && Place(options_.hand).lies_in(Place(options_.out)))
    return stop({"lies in the folder that is to be replaced", options_.hand, "copy it elsewhere"}, kExitUsage);
  if (const auto hand = load_profile(options_.hand); !hand) return stop(hand.error(), kExitUsage);
  return {};
}

Step ExperimentRun::take_folder() const {
  // Remove the files of an earlier experiment, if they are to be replaced.
  std::error_code error;
  if (options_.overwrite && fs::exists(options_.out + kMark, error)) {
    std::vector<std::string> written = {"recordings", "results", "snapshots", "plots", "figures"};
    for (const std::string& name : experiment_names())
      for (const char* ending : {".txt", ".csv", ".json", ".png"}) written.push_back(name + ending);
    for (const std::string& name : written) {
      fs::remove_all(options_.out + "/" + name, error);
      if (error) return stop({"cannot be removed: " + error.message(), options_.out + "/" + name, "check the path"});
    }
  }

  // Create the folder, and mark it as one that this command may replace.
  fs::create_directories(options_.out, error);
  if (error) return stop({"cannot be created: " + error.message(), options_.out, "check the path"}, kExitUsage);
  if (const auto marked = write_file_atomically(options_.out + kMark, "made by barehand experiment\n"); !marked)
    return stop(marked.error(), kExitUsage);
  return {};
}

std::string ExperimentRun::spec_of(const std::string& sequence) const {
  std::string spec = sequence;
  if (options_.frames) spec += ",frames=" + std::to_string(*options_.frames);
  for (const std::string& key : options_.keys) spec += "," + key;
  return spec;
}

Step ExperimentRun::make_folders() const {
  for (const char* folder : {"results", "figures"}) {
    std::error_code error;
    fs::create_directories(options_.out + "/" + folder, error);
    if (error) return stop({"cannot be created: " + error.message(), options_.out + "/" + folder, "check the path"});
  }
  return {};
}

tl::expected<std::int64_t, TrackFailure> ExperimentRun::render(const std::string& sequence) const {
  const std::string spec = spec_of(sequence);
  std::cerr << "rendering " << spec << std::endl;
  std::atomic<bool> stopped = false;
  const InterruptWatcher interrupt([&stopped] { stopped = true; });
  const auto frames = run_sim({spec, recording(sequence)}, [&](std::int64_t done, std::int64_t all) {
    return render_progress(done, all) && !stopped;
  });
  if (!frames) return stop(frames.error(), kExitUsage);
  if (stopped) return stop({"stopped", recording(sequence), ""}, kExitInterrupted);
  return *frames;
}

Step ExperimentRun::compare(const std::string& sequence) {
  // Render the sequence.
  const auto frames = render(sequence);
  if (!frames) return tl::unexpected(frames.error());
  if (auto made = make_folders(); !made) return made;

  // Track it with every variant.
  EvalReport compared;
  for (const ExperimentVariant& variant : plan_.variants) {
    auto row = measure(sequence, variant, *frames);
    if (!row) return tl::unexpected(row.error());
    compared.runs.push_back(row->run);
    report_.rows.push_back(std::move(*row));
  }

  // Write the same report and plots as `barehand eval`.
  const auto written = write_json_report(compared, options_.out + "/figures/" + sequence + ".json").and_then([&] {
    return write_plots(compared, options_.out + "/plots/" + sequence);
  });
  if (!written) return stop(written.error());
  return {};
}

tl::expected<ExperimentRow, TrackFailure> ExperimentRun::measure(const std::string& sequence,
                                                                 const ExperimentVariant& variant,
                                                                 std::int64_t frames) {
  // Report the progress.
  const std::string name = sequence + "." + variant.label;
  std::cerr << ++done_ << " of " << plan_.sequences.size() * plan_.variants.size() << ": " << sequence << ", "
            << variant.label << std::endl;

  // Set up the run of track: its input, its outputs, and how it runs.
  TrackOptions options;
  options.source = "folder:" + recording(sequence);
  if (!options_.hand.empty()) options.hands = {options_.hand};
  if (!options_.search_start) options.init = recording(sequence) + "/start_pose.json";
  options.result = options_.out + "/results/" + name + ".csv";
  options.overlay = options_.out + "/snapshots/" + name + "/";  // a folder, although the name looks like that of a file
  options.overlay_every = static_cast<int>((frames + kSnapshots - 1) / kSnapshots);
  options.threads = options_.threads;
  options.no_publish = true;

  // Track the sequence.
  const auto tracked = track(options, variant.config);
  if (!tracked) return tl::unexpected(tracked.error());
  if (tracked->stopped) return stop({"stopped", name, ""}, kExitInterrupted);
  if (tracked->exit_code != kExitOk) return stop({"was not tracked to the end", name, ""}, tracked->exit_code);

  // Compare the result with the truth.
  const auto table = read_table(options.result);
  if (!table) return stop(table.error());
  auto run = evaluate_run(variant.label, recording(sequence) + "/truth.csv", options.result, *table);
  if (!run) return stop(run.error());
  return ExperimentRow{sequence, std::move(*run), mean_ms(tracked->health, "preprocess"),
                       mean_ms(tracked->health, "track")};
}

}  // namespace

tl::expected<ExperimentReport, TrackFailure> run_experiment(const ExperimentPlan& plan,
                                                            const ExperimentOptions& options) {
  return ExperimentRun(plan, options).run();
}

}  // namespace barehand
