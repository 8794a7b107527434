// Opens the source of frames that the user asks for with --source.
#include "app/shared/source_factory.h"

#include "app/shared/checked_source.h"
#include "drivers/folder/folder_source.h"
#include "drivers/lcm/lcm_live_source.h"
#include "drivers/lcm/lcm_log_source.h"
#include "drivers/mcap/mcap_source.h"
#include "drivers/openni2/openni_file_source.h"
#include "drivers/openni2/openni_live_source.h"
#include "drivers/synthetic/synthetic_source.h"
#include "drivers/usb/libusb_bus.h"
#include "io/file_bytes.h"
#include "io/hand/hand_json.h"
#include "io/hand/path_of_hand.h"
#include "io/lcm/log_names.h"
#include "io/recording/stamped_list.h"

namespace barehand {
namespace {

constexpr const char* kKinds = "folder:DIR, log:FILE, lcm, openni2, openni2:SENSOR, openni2:FILE.oni, sim:NAME";

bool is_oni_file(const std::string& name) { return name.ends_with(".oni"); }

/// Returns a warning if the recording's lists name images outside of its folder: a list of unknown origin may name any
/// file of this machine.
std::optional<std::string> outside_warning(const Recording& recording) {
  std::int64_t count = 0;
  std::string first;
  for (const RecordingEntry& entry : recording.entries)
    for (const std::string& file : {entry.depth_file, entry.colour_file})
      if (!file.empty() && is_outside(recording.directory, file) && count++ == 0) first = file;
  if (count == 0) return std::nullopt;
  return recording.directory + ": its lists name " + std::to_string(count) + " images outside of the folder, first " +
         first;
}

Result<OpenSource> open_folder(const std::string& directory, const SourceRequest& request) {
  auto source = FolderSource::open(directory, {request.start, request.step});
  if (!source) return tl::unexpected(source.error());

  // Collect what the recording says about itself.
  OpenSource open;
  open.frames = (*source)->remaining();
  for (const int k : {0, 1}) {
    const std::string path = path_of_hand(directory + "/hand.json", k, Handedness::left);
    if (!is_missing(path)) open.hands.push_back({[path] { return load_profile(path); }, path});
  }

  // Take the nominal rate, and warn of images that are outside the recording's folder.
  open.fps = (*source)->recording().fps;
  open.warnings = (*source)->recording().warnings;
  if (const auto outside = outside_warning((*source)->recording())) open.warnings.push_back(*outside);
  open.source = std::move(*source);
  return open;
}

Result<OpenSource> open_log(const std::string& path, const SourceRequest& request) {
  LcmLogOptions options;
  options.channel = request.channel;
  options.start = request.start;
  options.step = request.step;
  options.foreign = request.foreign;
  auto source = LcmLogSource::open(path, options);
  if (!source) return tl::unexpected(source.error());

  // Collect what the log says about itself, and warn of what is missing in it.
  OpenSource open;
  open.frames = (*source)->remaining();
  open.fps = (*source)->fps();
  open.warnings = (*source)->warnings();
  if (const auto bytes = (*source)->damaged_bytes(); bytes > 0)
    open.warnings.push_back(path + ": " + std::to_string(bytes) +
                            " bytes are damaged or cut off; every complete event is played");

  if (const auto& left_out = (*source)->left_out(); !left_out.empty())
    open.warnings.push_back(path + ": " + std::to_string(left_out.size()) + " of its logs cannot be played, first " +
                            left_out.front().message());
  open.source = std::move(*source);
  return open;
}

Result<OpenSource> open_mcap(const std::string& path, const SourceRequest& request) {
  McapOptions options;
  options.channel = request.channel;
  options.start = request.start;
  options.step = request.step;
  options.foreign = request.foreign;
  auto source = McapSource::open(path, options);
  if (!source) return tl::unexpected(source.error());

  // Collect what the file says about itself.
  OpenSource open;
  open.frames = (*source)->remaining();
  open.fps = (*source)->fps();
  open.warnings = (*source)->warnings();
  open.source = std::move(*source);
  return open;
}

/// Opens an LCM log or an MCAP file, which are distinguished by their content. If the file does not exist, the draft
/// that a killed recorder left is played instead.
Result<OpenSource> open_log_or_mcap(const std::string& path, const SourceRequest& request) {
  const auto files = find_logs(path);
  const bool mcap = files && files->files.size() == 1 && mcap::is_mcap(files->files.front());
  return mcap ? open_mcap(files->files.front(), request) : open_log(path, request);
}

Result<OpenSource> open_live(const SourceRequest& request) {
  LcmLiveOptions options;
  options.channel = request.channel;
  options.foreign = request.foreign;
  options.capacity = request.live_capacity;
  auto source = LcmLiveSource::open(request.lcm_url, options);
  if (!source) return tl::unexpected(source.error());
  OpenSource open;
  open.if_silent = "Does a camera's program send them on this LCM network?";
  if (request.channel.empty())
    open.if_silent += " A channel whose name does not end in RGBD_FRAME has to be named: run.frame_channel.";
  if (const auto shortfall = LcmBus::receive_buffer_shortfall(request.lcm_url))
    open.warnings.push_back(shortfall->message());
  open.source = std::move(*source);
  return open;
}

/// Opens an .oni file, or a sensor whose address contains `argument` and which may be plugged in later.
Result<OpenSource> open_openni(const std::string& argument, const SourceRequest& request, const Clock& clock) {
  if (const auto possible = check(request.openni2.camera, request.spec + ", fx, fy, cx, cy"); !possible)
    return tl::unexpected(possible.error());

  // A live sensor gets a queue of its own.
  OpenSource open;
  if (!is_oni_file(argument)) {
    open.fps = request.openni2.fps;
    open.if_silent = "Is the sensor plugged in?";
    open.source = std::make_unique<OpenNiLiveSource>(argument, request.openni2, request.live_capacity, clock,
                                                     std::make_unique<LibUsbBus>());
    return open;
  }

  // A recording of OpenNI2 is played like any other recording.
  auto source = OpenNiFileSource::open(argument, request.openni2, request.start.value_or(0), request.step);
  if (!source) return tl::unexpected(source.error());
  open.frames = (*source)->remaining();
  open.fps = (*source)->fps();
  if (const auto warning = (*source)->warning()) open.warnings.push_back(*warning);
  open.source = std::move(*source);
  return open;
}

Result<OpenSource> open_simulator(const std::string& text, const Clock& clock) {
  auto source = synthetic::SyntheticSource::open(text, clock);
  if (!source) return tl::unexpected(source.error());
  OpenSource open;
  if (const std::int64_t frames = (*source)->remaining(); frames >= 0) open.frames = frames;
  open.fps = (*source)->fps();
  open.if_silent = "The simulator draws the next one.";
  for (const synthetic::SimulatedHand& hand : (*source)->hands())
    open.hands.push_back({[profile = hand.profile] { return Result<HandProfile>(profile); },
                          "of the simulated " + std::string(to_string(hand.profile.handedness)) + " hand"});
  open.source = std::move(*source);
  return open;
}

/// Whether options are given that only recordings have.
bool chooses_frames(const SourceRequest& request) { return request.start || request.step != 1; }

Result<OpenSource> open_kind(const SourceRequest& request, const Clock& clock) {
  // Split the description into the kind of the source and its argument.
  const auto colon = request.spec.find(':');
  const std::string kind = request.spec.substr(0, colon);
  const std::string argument = colon == std::string::npos ? "" : request.spec.substr(colon + 1);

  // Check the options that only recordings have.
  if (request.step == 0)
    return fail("a step of 0 would repeat one frame without end", "--step", "give 1, 2, ... or -1, -2, ...");
  const bool recording = kind == "folder" || kind == "log" || (kind == "openni2" && is_oni_file(argument));
  if (!recording && chooses_frames(request))
    return fail("--start and --step are for recordings", request.spec, "leave them out");

  // Open the source by its kind.
  if (kind == "lcm" && colon == std::string::npos) return open_live(request);
  if (kind == "openni2") return open_openni(argument, request, clock);
  if (kind == "sim" && !argument.empty()) return open_simulator(argument, clock);
  if (recording && argument.empty())
    return fail("the source names no file", request.spec, std::string("give ") + kKinds);
  if (kind == "folder") return open_folder(argument, request);
  if (kind == "log") return open_log_or_mcap(argument, request);
  return fail("unknown source", request.spec, std::string("give ") + kKinds);
}

}  // namespace

bool needs_network(const SourceRequest& request) {
  return request.spec == "lcm" && !chooses_frames(request) && LcmBus::is_network(request.lcm_url);
}

Result<OpenSource> open_source(const SourceRequest& request, const Clock& clock) {
  auto open = open_kind(request, clock);
  if (open && open->if_silent.empty()) open->if_silent = "The next one of the recording is being read.";

  // Check the images, except for the simulator's, which may be identical if they have no noise.
  if (open && !request.spec.starts_with("sim:"))
    open->source = std::make_unique<CheckedSource>(std::move(open->source), request.depth, clock);
  return open;
}

}  // namespace barehand
