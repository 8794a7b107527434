// Checks the outputs of `barehand track`, and chooses free names for those of a live run.
#include "app/track/track_outputs.h"

#include <algorithm>
#include <filesystem>

#include "app/shared/run_inputs.h"
#include "io/hand/path_of_hand.h"
#include "io/lcm/log_names.h"
#include "io/mcap/mcap_writer.h"
#include "io/place.h"
#include "io/video/video_file.h"

namespace barehand {
namespace {

using Kind = Output::Kind;

/// The outputs of an option that writes one file per hand.
std::vector<Output> of_hands(const std::string& option, const std::string& path,
                             const TwoHandTracker::Profiles& hands) {
  std::vector<Output> outputs;
  if (path.empty()) return outputs;
  for (std::size_t k = 0; k < hands.size(); ++k)
    outputs.push_back({option, path_of_hand(path, static_cast<int>(k), hands[k]->handedness)});
  return outputs;
}

/// Refuses a pipe or a device if there are two hands: it can take the table or the profile of only one.
Result<void> check_room_for(const TwoHandTracker::Profiles& hands, const std::string& option, const std::string& path) {
  if (hands.size() < 2 || path.empty() || !target_of(path).direct) return {};
  return fail("is one pipe or device, and two hands are tracked", option + " " + path,
              "give a file, or track one hand");
}

/// Refuses a pipe as an overlay, unless it takes the video of a recording.
Result<void> check_pipe_of_overlay(const std::string& path, bool live) {
  std::error_code ignored;
  if (!std::filesystem::is_fifo(path, ignored)) return {};
  if (!video_format(path))
    return fail("is a pipe, and images need a folder", "--overlay " + path,
                "give a folder, or a name that ends in .mp4, .mkv, .webm or .avi");
  if (!live) return {};
  return fail("is a pipe, whose reader could hold up the tracking of a live source", "--overlay " + path,
              "give a file or a folder");
}

/// The log that LCM itself writes if the network is file://PATH?mode=w.
Output of_network(const std::string& url) {
  const std::string file = "file://";
  const bool writes = url.starts_with(file) && url.find("mode=w") != std::string::npos;
  return {"--lcm-url", writes ? url.substr(file.size(), url.find('?') - file.size()) : ""};
}

/// An overlay whose name ends like a video is a file; any other is a folder of images.
Kind kind_of_overlay(const std::string& path) { return video_format(path) ? Kind::file : Kind::pictures; }

std::vector<Output> outputs_of(const TrackOptions& o, const TwoHandTracker::Profiles& hands) {
  std::vector<Output> outputs = of_hands("--result", o.result, hands);
  outputs.push_back({"--states-log", o.states_log});
  outputs.push_back({"--mcap", o.mcap});
  outputs.push_back({"--log-decisions", o.decisions});
  outputs.push_back({"--overlay", o.overlay, kind_of_overlay(o.overlay)});
  for (Output& profile : of_hands("--save-hand", o.save_hand, hands)) outputs.push_back(std::move(profile));
  outputs.push_back({"--out", o.saved_later});
  if (!o.no_publish) outputs.push_back(of_network(o.lcm_url));
  return outputs;
}

/// Refuses a file whose folder is missing, so that a typing error ends the run before its first frame.
Result<void> check_folders(const std::vector<Output>& outputs) {
  std::error_code ignored;
  for (const Output& output : outputs) {
    const std::filesystem::path folder = std::filesystem::path(output.path).parent_path();
    if (output.kind == Kind::file && !folder.empty() && !std::filesystem::exists(folder, ignored))
      return fail("there is no folder " + folder.string(), output.option + " " + output.path, "make the folder first");
  }
  return {};
}

/// Checks the endings of outputs whose kind they say.
Result<void> check_endings(const TrackOptions& o) {
  return check_ending({"--mcap", o.mcap}, mcap::is_mcap_name(o.mcap), ".mcap")
      .and_then([&] {
        return check_ending({"--states-log", o.states_log}, is_log_name(o.states_log), ".lcmlog");
      })
      .and_then([&] {
        return check_ending({"--overlay", o.overlay, kind_of_overlay(o.overlay)}, video_format(o.overlay) != nullptr,
                            ".mp4, .mkv, .webm or .avi");
      });
}

std::string numbered(const std::string& path, int number) {
  std::filesystem::path whole(path);
  if (!whole.has_filename()) whole = whole.parent_path();  // removes the slash at the end of a path like "folder/"
  return whole.parent_path() / (whole.stem().string() + "-" + std::to_string(number) + whole.extension().string());
}

/// Returns `path` if `is_taken` is false for it, otherwise the first numbered name for which it is false.
template <class IsTaken>
std::string free_name(const std::string& path, const IsTaken& is_taken) {
  std::string name = path;
  for (int number = 2; !name.empty() && is_taken(name); ++number) name = numbered(path, number);
  return name;
}

}  // namespace

Result<TrackOptions> resolve_outputs(TrackOptions options, const std::string& config_path,
                                     const TwoHandTracker::Profiles& hands, bool live) {
  const auto room = check_room_for(hands, "--result", options.result).and_then([&] {
    return check_room_for(hands, "--save-hand", options.save_hand);
  });
  if (!room) return tl::unexpected(room.error());
  if (const auto good = check_pipe_of_overlay(options.overlay, live); !good) return tl::unexpected(good.error());

  // Check the file names as the user gave them, before free numbers are appended to names that exist.
  std::vector<InputFile> inputs{{"--config", config_path}};
  for (const std::string& path : profile_paths(options.hands)) inputs.push_back({"--hand", path});
  if (options.init != "auto") inputs.push_back({"--init", options.init});
  for (const std::string& object : options.objects.paths) inputs.push_back({"--object", object});
  const SourceFiles source = files_of_source(options.source);
  const bool number = live && !options.overwrite;
  const std::vector<Output> outputs = outputs_of(options, hands);
  if (const auto good = check_outputs(source, inputs, outputs, options.overwrite || number); !good)
    return tl::unexpected(good.error());
  if (const auto good = check_endings(options); !good) return tl::unexpected(good.error());
  if (const auto good = check_folders(outputs); !good) return tl::unexpected(good.error());
  if (!number) return options;

  // Give a number to the names that an earlier run has taken.
  const auto some_taken = [](const std::vector<Output>& outputs) {
    for (const Output& output : outputs)
      if (is_taken(output)) return true;
    return false;
  };

  // A table is written in one file for each hand, and an overlay may be a folder.
  const auto table_taken = [&](const std::string& path) { return some_taken(of_hands("", path, hands)); };
  const auto file_taken = [&](const std::string& path) { return is_taken({"", path}); };
  const auto overlay_taken = [&](const std::string& path) { return is_taken({"", path, kind_of_overlay(path)}); };

  options.result = free_name(options.result, table_taken);
  options.states_log = free_name(options.states_log, file_taken);
  options.mcap = free_name(options.mcap, file_taken);
  options.decisions = free_name(options.decisions, file_taken);
  options.overlay = free_name(options.overlay, overlay_taken);
  options.save_hand = free_name(options.save_hand, table_taken);
  return check_outputs(source, inputs, outputs_of(options, hands), false).map([&] { return options; });
}

bool writes_to_standard_output(const TrackOptions& o) {
  for (const auto file : TrackOptions::kFiles)
    if (is_standard_output(o.*file)) return true;
  return is_standard_output(o.overlay) || is_standard_output(of_network(o.lcm_url).path);
}

}  // namespace barehand
