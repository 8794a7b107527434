// The command `barehand eval`, which compares results with the truth.
#include "app/eval/eval_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/eval/eval_report.h"
#include "app/eval/stated_contacts.h"
#include "app/eval/stated_grasps.h"
#include "app/eval/stated_objects.h"
#include "app/eval/stated_poses.h"
#include "app/shared/exit_code.h"
#include "app/shared/outputs.h"
#include "app/shared/run_inputs.h"
#include "app/shared/standard_streams.h"
#include "io/mesh/mesh_file.h"
#include "io/recording/recording.h"

namespace barehand {
namespace {

struct EvalOptions {
  std::vector<std::string> truths, results, labels, states, contacts, grasps, objects;
  std::string hand, plots, json, fingertips, recording;
  std::optional<std::int64_t> start;
  std::int64_t step = 1;
  bool overwrite = false;
};

Result<void> check(const EvalOptions& o) {
  // Require a result, and a reference with which it is compared.
  if (o.results.empty() && o.states.empty()) return fail("no result is given", "eval", "give --result or --states");
  if (o.truths.empty() && o.fingertips.empty() && o.grasps.empty())
    return fail("no reference is given", "eval", "give --truth, --grasps, or --fingertips with --recording and --hand");

  // Require that files which belong together are given equally often.
  if (!o.results.empty() && o.truths.size() > 1 && o.truths.size() != o.results.size())
    return fail("--truth is given " + std::to_string(o.truths.size()) + " times for " +
                    std::to_string(o.results.size()) + " results",
                "eval", "give it once for all results, or once for each");
  const bool only_grasps = o.truths.empty() && o.contacts.empty() && !o.grasps.empty();
  if (!o.states.empty() && !only_grasps && o.states.size() != o.truths.size())
    return fail("--states is given " + std::to_string(o.states.size()) + " times for " +
                    std::to_string(o.truths.size()) + " truths",
                "eval", "give a log of hand states for each --truth");

  // Each table of contacts, grasps or objects belongs to one log of states.
  if (!o.contacts.empty() && o.contacts.size() != o.states.size())
    return fail("--contacts is given " + std::to_string(o.contacts.size()) + " times for " +
                    std::to_string(o.states.size()) + " logs of states",
                "eval", "give a contact table for each --states");
  if (!o.grasps.empty() && o.grasps.size() != o.states.size())
    return fail("--grasps is given " + std::to_string(o.grasps.size()) + " times for " +
                    std::to_string(o.states.size()) + " logs of states",
                "eval", "give a table of grasps for each --states");

  if (!o.objects.empty() && o.objects.size() != o.states.size())
    return fail("--objects is given " + std::to_string(o.objects.size()) + " times for " +
                    std::to_string(o.states.size()) + " logs of states",
                "eval", "give a table of object poses for each --states");

  // Check the remaining options.
  if (!o.labels.empty() && o.labels.size() != o.results.size())
    return fail("--label must be given once for each --result", "eval");
  if (!o.fingertips.empty() && (o.recording.empty() || o.hand.empty()))
    return fail("--fingertips needs the camera and the fingers' thickness", "eval", "add --recording DIR and --hand");
  if (o.start.value_or(0) < 0) return fail("no frame has a negative number", "--start", "give the number of a frame");
  if (o.step == 0)
    return fail("a step of 0 would repeat one frame without end", "--step", "choose 1, 2 ... or -1, -2 ...");
  return {};
}

/// The mesh of an object, beside the table of its poses as the simulator writes both: NAME.obj beside objects.csv, and
/// FILE.NAME.obj beside FILE.objects.csv.
std::filesystem::path mesh_of(const std::filesystem::path& table, const std::string& name) {
  const std::string file = table.filename().string(), ending = "objects.csv";
  const std::string begin = file.ends_with(ending) ? file.substr(0, file.size() - ending.size()) : "";
  return table.parent_path() / (begin + name + ".obj");
}

/// Checks that the files to be written may be written and are none of those that are read. The plots are those that
/// will be drawn.
Result<void> check_written(const EvalOptions& o) {
  // List the files that are read.
  std::vector<InputFile> inputs{{"--fingertips", o.fingertips}};
  for (const std::string& path : profile_paths({o.hand})) inputs.push_back({"--hand", path});
  for (const std::string& path : o.results) inputs.push_back({"--result", path});
  for (const std::string& path : o.truths) inputs.push_back({"--truth", path});
  for (const std::string& path : o.states) inputs.push_back({"--states", path});
  for (const std::string& path : o.grasps) inputs.push_back({"--grasps", path});
  for (const std::string& path : o.contacts) inputs.push_back({"--contacts", path});
  for (const std::string& path : o.objects) {
    inputs.push_back({"--objects", path});
    if (const auto truth = read_object_truth(path)) inputs.push_back({"--objects", mesh_of(path, truth->name)});
  }

  // List the files that are written.
  std::vector<Output> outputs{{"--json", o.json}};
  const auto plot = [&](const char* name) {
    if (!o.plots.empty()) outputs.push_back({"--plots", o.plots + "/" + name});
  };

  // Add the plots that will be drawn.
  if (!o.results.empty() && !o.truths.empty())
    for (const char* name : {"runs.png", "segments.png", "time.png"}) plot(name);
  if (!o.fingertips.empty()) plot("fingertips.png");
  if (!o.states.empty() && !o.truths.empty())
    for (const char* name : {"reliability.png", "confidence.png"}) plot(name);

  // Compare the written files with those that are read.
  const SourceFiles recording = o.recording.empty() ? SourceFiles() : files_of_source("folder:" + o.recording);
  return check_outputs(recording, inputs, outputs, o.overwrite);
}

/// Reports results without any tracked hand, and objects that were never found. These are valid input, and the worst of
/// results.
void say_untracked(const EvalReport& report) {
  for (const EvaluatedRun& run : report.runs)
    if (run.evaluation.untracked == run.evaluation.frames.size())
      std::fprintf(stderr, "barehand eval: %s: no hand was tracked in any of the %zu frames\n", run.result_path.c_str(),
                   run.evaluation.frames.size());
  for (const ObjectEvaluation& object : report.objects)
    if (object.stated == 0)
      std::fprintf(
          stderr,
          "barehand eval: object %s is stated in none of the %zu frames: it was not found, or the states are of a "
          "track without --object\n",
          object.name.c_str(), object.frames);
}

std::string label_of(const EvalOptions& o, std::size_t i) {
  return o.labels.empty() ? std::filesystem::path(o.results[i]).stem().string() : o.labels[i];
}

Result<void> evaluate_runs(const EvalOptions& o, const std::vector<ResultTable>& results, EvalReport& report) {
  for (std::size_t i = 0; i < results.size() && !o.truths.empty(); ++i) {
    const std::string& truth = o.truths[o.truths.size() == 1 ? 0 : i];
    auto run = evaluate_run(label_of(o, i), truth, o.results[i], results[i], {o.start, o.step});
    if (!run) return tl::unexpected(run.error());
    report.runs.push_back(std::move(*run));
  }
  return {};
}

Result<void> add_reliability(const EvalOptions& o, EvalReport& report) {
  std::vector<std::pair<ResultTable, StatedPoses>> sequences;
  for (std::size_t i = 0; i < o.states.size(); ++i) {
    auto truth = read_table(o.truths[i]);
    if (!truth) return tl::unexpected(truth.error());
    auto states = read_stated_poses(o.states[i]);
    if (!states) return tl::unexpected(states.error());
    sequences.emplace_back(std::move(*truth), std::move(*states));
  }
  auto reliability = evaluate_reliability(sequences);
  if (!reliability) return tl::unexpected(reliability.error());
  report.reliability = std::move(*reliability);
  return {};
}

Result<void> add_contacts(const EvalOptions& o, EvalReport& report) {
  std::vector<ContactSequence> sequences;

  // Read the three files of each sequence.
  for (std::size_t i = 0; i < o.contacts.size(); ++i) {
    auto poses = read_table(o.truths[i]);
    if (!poses) return tl::unexpected(poses.error());
    auto truth = read_contact_truth(o.contacts[i]);
    if (!truth) return tl::unexpected(truth.error());
    auto stated = read_stated_contacts(o.states[i]);
    if (!stated) return tl::unexpected(stated.error());
    sequences.push_back({std::move(*poses), std::move(*truth), std::move(*stated)});
  }

  // Evaluate all sequences together.
  auto contacts = evaluate_contacts(sequences);
  if (!contacts) return tl::unexpected(contacts.error());
  report.contacts = std::move(*contacts);
  return {};
}

Result<void> add_grasps(const EvalOptions& o, EvalReport& report) {
  std::vector<GraspSequence> sequences;
  for (std::size_t i = 0; i < o.grasps.size(); ++i) {
    auto truth = read_grasp_truth(o.grasps[i]);
    if (!truth) return tl::unexpected(truth.error());
    auto stated = read_stated_grasps(o.states[i]);
    if (!stated) return tl::unexpected(stated.error());
    sequences.push_back({std::move(*truth), std::move(*stated)});
  }
  auto grasps = evaluate_grasps(sequences);
  if (!grasps) return tl::unexpected(grasps.error());
  report.grasps = std::move(*grasps);
  return {};
}

Result<void> add_objects(const EvalOptions& o, EvalReport& report) {
  for (std::size_t i = 0; i < o.objects.size(); ++i) {
    // Read the true poses, and the mesh that stands beside their table.
    auto truth = read_object_truth(o.objects[i]);
    if (!truth) return tl::unexpected(truth.error());
    const std::filesystem::path mesh = mesh_of(o.objects[i], truth->name);
    if (!std::filesystem::exists(mesh))
      return fail("there is no such file", mesh.string(), "put the object's mesh beside the table of its poses");
    const auto loaded = load_mesh(mesh.string(), LengthUnit::metre);
    if (!loaded) return tl::unexpected(loaded.error());

    // Compare them with the published states.
    const auto stated = read_stated_objects(o.states[i]);
    if (!stated) return tl::unexpected(stated.error());
    auto evaluation = evaluate_object(*truth, *stated, loaded->mesh);
    if (!evaluation) return tl::unexpected(evaluation.error());
    report.objects.push_back(std::move(*evaluation));
  }
  return {};
}

Result<void> compare_fingertips(const EvalOptions& o, const std::vector<ResultTable>& results,
                                const HandProfile& profile, EvalReport& report) {
  const auto labels = read_fingertip_labels(o.fingertips);
  if (!labels) return tl::unexpected(labels.error());
  const auto recording = open_recording(o.recording);
  if (!recording) return tl::unexpected(recording.error());
  if (labels->empty()) return fail("holds no labels", o.fingertips, "there is nothing to compare with");
  report.fingertips = evaluate_fingertips(*labels, results, profile, recording->camera);
  return {};
}

Result<EvalReport> evaluate_all(const EvalOptions& o) {
  std::vector<ResultTable> results;
  for (const std::string& path : o.results) {
    auto result = read_table(path);
    if (!result) return tl::unexpected(result.error());
    results.push_back(std::move(*result));
  }

  // Compare the runs with the truth.
  EvalReport report;
  if (const auto runs = evaluate_runs(o, results, report); !runs) return tl::unexpected(runs.error());

  // Evaluate what is published beside the pose: uncertainty, contacts, grasps and objects.
  if (!o.states.empty() && !o.truths.empty())
    if (const auto added = add_reliability(o, report); !added) return tl::unexpected(added.error());
  if (!o.contacts.empty())
    if (const auto added = add_contacts(o, report); !added) return tl::unexpected(added.error());
  if (!o.grasps.empty())
    if (const auto added = add_grasps(o, report); !added) return tl::unexpected(added.error());
  if (const auto added = add_objects(o, report); !added) return tl::unexpected(added.error());

  // Compare with the size of the hand, and with labelled fingertips.
  if (o.hand.empty()) return report;
  const auto hand = load_hand(o.hand);
  if (!hand) return tl::unexpected(hand.error());
  report.hand_length = hand->profile->hand_length();
  if (!o.fingertips.empty())
    if (const auto tips = compare_fingertips(o, results, *hand->profile, report); !tips)
      return tl::unexpected(tips.error());
  return report;
}

Result<void> write(const EvalReport& report, const EvalOptions& o) {
  if (!o.json.empty())
    if (const auto written = write_json_report(report, o.json); !written) return written;
  if (!o.plots.empty()) return write_plots(report, o.plots);
  return {};
}

int run(const EvalOptions& o) {
  const auto report = check(o).and_then([&] { return check_written(o); }).and_then([&] { return evaluate_all(o); });
  if (!report) return failed("eval", report.error(), kExitUsage);
  say_untracked(*report);
  std::fputs(text_report(*report).c_str(), is_standard_output(o.json) ? stderr : stdout);
  const auto written = write(*report, o);
  if (written && o.json.empty() && o.plots.empty()) return printed(kExitOk);
  return written ? kExitOk : failed("eval", written.error(), kExitFailure);
}

}  // namespace

void add_eval_command(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<EvalOptions>();
  CLI::App* eval = app.add_subcommand("eval", "Compare results with ground truth: the paper's metrics, plots");

  // Add options for the results, and for what they are compared with.
  eval->add_option("--result", o->results, "result table; several are compared with one another");
  eval->add_option("--truth", o->truths, "truth table: one for all results, or one for each");
  eval->add_option("--states", o->states,
                   "log of hand states (LCM or MCAP), one for each truth, to check the stated uncertainty");
  eval->add_option("--contacts", o->contacts,
                   "contact table, one for each log of states, to check the stated contacts");
  eval->add_option("--grasps", o->grasps, "table of grasps, one for each log of states, to check the stated grasps");
  eval->add_option("--objects", o->objects,
                   "table of object poses (objects.csv, with the mesh beside it), one for each log of states, to check "
                   "the poses of the first --object of track");

  // Add options for how the results are named, and how their frames are numbered.
  eval->add_option("--label", o->labels, "name of each result in tables and plots");
  eval->add_option(
      "--hand", o->hand,
      "hand.json, or right or left, the shipped mean adult hand: errors as a fraction of the hand's length");
  eval->add_option("--start", o->start, "first frame of the run, as given to track");
  eval->add_option("--step", o->step, "step between frames, as given to track");

  // Add options for what is written.
  eval->add_option("--plots", o->plots, "folder for plots (PNG)");
  eval->add_option("--json", o->json, "file for the figures");
  add_overwrite_option(*eval, o->overwrite);

  // Add options for labelled fingertips.
  eval->add_option("--fingertips", o->fingertips, "fingertips labelled in the image: frame,finger,u,v,visible");
  eval->add_option("--recording", o->recording, "the recording that --fingertips belongs to");
  eval->callback([o, &exit_code] { exit_code = run(*o); });
}

}  // namespace barehand
