// The command `barehand sim`, which renders simulated sequences.
#include "app/sim/sim_command.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <memory>

#include "app/shared/exit_code.h"
#include "app/shared/interrupt.h"
#include "app/shared/outputs.h"
#include "app/shared/standard_streams.h"
#include "app/sim/render_progress.h"
#include "app/sim/sim_run.h"
#include "drivers/synthetic/synthetic_spec.h"

namespace barehand {
namespace {

/// The arguments of `barehand sim`; empty ones were not given.
struct SimArguments {
  std::string name, out, noise, seed, frames, fps, hand;
  std::vector<std::string> set;
  bool list = false, overwrite = false;
};

/// The specification of the sequence, "NAME,key=value,...".
std::string spec_of(const SimArguments& a) {
  std::string spec = a.name;
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) spec += std::string(",") + key + "=" + value;
  };
  add("noise", a.noise);
  add("seed", a.seed);
  add("frames", a.frames);
  add("fps", a.fps);
  add("hand", a.hand);
  for (const std::string& pair : a.set) spec += "," + pair;
  return spec;
}

void print_list() {
  for (const synthetic::SequenceInfo& s : synthetic::sequence_list())
    std::printf("%-14s %3d frames at %2.0f Hz  %s\n", s.name.c_str(), s.frames, s.fps, s.description.c_str());
  std::printf("\nkeys of --set and of track --source sim:NAME,key=value,...\n%s",
              synthetic::synthetic_spec_help().c_str());
}

int run(const SimArguments& a) {
  // Listing needs no further arguments.
  if (a.list) {
    print_list();
    return printed(kExitOk);
  }

  // Check the arguments.
  if (a.name.empty())
    return failed("sim", {"no sequence is given", "sim", "barehand sim --list names them"}, kExitUsage);
  if (a.out.empty())
    return failed("sim", {"--out is missing", "sim", "give a folder, or a file that ends with .lcmlog or .mcap"},
                  kExitUsage);

  // Render the sequence. An error before the first frame means that an argument is wrong.
  std::int64_t done = 0;
  std::atomic<bool> stop = false;
  const InterruptWatcher interrupt([&stop] { stop = true; });
  std::FILE* told = is_standard_output(a.out) ? stderr : stdout;
  const auto frames = run_sim({spec_of(a), a.out, a.overwrite}, [&](std::int64_t now, std::int64_t all) {
    done = now;
    return render_progress(now, all) && !stop;
  });

  if (!frames) return failed("sim", frames.error(), done > 0 ? kExitFailure : kExitUsage);
  std::fprintf(told, "%lld frames in %s\n", static_cast<long long>(*frames), a.out.c_str());
  return stop ? kExitInterrupted : kExitOk;
}

}  // namespace

void add_sim_command(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<SimArguments>();
  CLI::App* sim = app.add_subcommand("sim", "Render a synthetic sequence of a hand with ground truth");

  // Add options for what is rendered, and where it is written.
  sim->add_option("name", a->name, "sequence, see --list; keys may follow: NAME,key=value,...");
  sim->add_option("--out", a->out, "folder to create, FILE.lcmlog or FILE.mcap");
  add_overwrite_option(*sim, a->overwrite);
  sim->add_option("--noise", a->noise, "none, kinect or tof");
  sim->add_option("--seed", a->seed, "seed of motion and noise");
  sim->add_option("--frames", a->frames, "number of frames");
  sim->add_option("--fps", a->fps, "frames per second, other than the sequence's own");
  sim->add_option("--hand", a->hand, "right or left, where a sequence shows one hand");

  // Add options for all other keys and for the list.
  sim->add_option("--set", a->set, "key=value, any key of --list; may be repeated");
  sim->add_flag("--list", a->list, "list the sequences and keys");

  // Name the files that are written as well.
  sim->footer(
      "A file, here FILE.lcmlog, gets FILE.truth.csv, FILE.hand.json and FILE.start_pose.json beside it; where "
      "two hands are seen, "
      "those of the left one end in _left. Where a hand grasps an object, there are also FILE.objects.csv, "
      "FILE.contacts.csv, FILE.grasps.csv and the object's mesh, FILE.NAME.obj. Ctrl-C: what is written so far is a "
      "complete recording.");
  sim->callback([a, &exit_code] { exit_code = run(*a); });
}

}  // namespace barehand
