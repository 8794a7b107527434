// Runs `barehand record` and `barehand convert`: opens source and destination and copies the frames.
#include "app/record/run_copy.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stop_token>
#include <utility>

#include "app/record/copy_frames.h"
#include "app/shared/exit_code.h"
#include "app/shared/interrupt.h"
#include "app/shared/outputs.h"
#include "app/shared/pipe_readers.h"
#include "app/shared/run_inputs.h"
#include "core/both.h"
#include "io/data_files.h"
#include "pipeline/service_manager.h"

namespace barehand {
namespace fs = std::filesystem;
namespace {

FrameWriterOptions writer_options(const CopyRequest& request, double fps, const Clock& clock) {
  FrameWriterOptions options;

  // Translate the names of the encodings, which the option parser has checked already.
  options.encoding.depth = request.depth == "raw"    ? DepthEncoding::raw16
                           : request.depth == "zlib" ? DepthEncoding::zlib
                                                     : DepthEncoding::rvl_zstd;
  options.encoding.colour = request.colour == "none"   ? ColourEncoding::none
                            : request.colour == "raw"  ? ColourEncoding::raw_rgb
                            : request.colour == "jpeg" ? ColourEncoding::jpeg
                                                       : ColourEncoding::png;
  options.encoding.jpeg_quality = request.jpeg_quality;

  // Give the properties of the log itself.
  options.channel = request.out_channel;
  options.fps = fps / std::abs(static_cast<double>(request.source.step));
  options.overwrite = request.overwrite;
  options.clock = &clock;

  if (request.max_size > 0 || request.max_age > 0 || request.quota > 0)
    options.rotation =
        LogRotation{static_cast<std::int64_t>(request.max_size), static_cast<std::int64_t>(request.max_age * 1e6),
                    static_cast<std::int64_t>(request.quota)};
  return options;
}

/// Path of a configuration's file; "" if none is read.
std::string config_file(const std::string& name) { return name.empty() ? "" : find_config(name).value_or(""); }

Output output_of(const CopyRequest& request, bool rotates) {
  const Output::Kind log = rotates ? Output::Kind::log_set : Output::Kind::file;
  if (is_mcap_path(request.out)) return {request.out_option, request.out, Output::Kind::file};
  return {request.out_option, request.out, is_log_path(request.out) ? log : Output::Kind::recording};
}

/// Why a copy that reached the end of its source has failed nevertheless; none if it has succeeded.
std::optional<Error> failure_of(const CopyResult& result, const std::string& source, bool live) {
  const std::string frames = std::to_string(result.written + result.skipped);
  if (result.written == 0 && live) return Error{"no frame arrived, so nothing is written", source, ""};
  if (result.written == 0)
    return Error{"nothing could be read: none of " + frames + " frames, so nothing is written", source, ""};
  if (!live && result.skipped > result.written)
    return Error{"most frames are missing: " + std::to_string(result.skipped) + " of " + frames + " could not be read",
                 source, ""};
  return std::nullopt;
}

int exit_code_of(const CopyResult& result, bool live, int signal) {
  if (result.error) return kExitFailure;
  if (result.stopped) return signal == SIGINT || !live ? kExitInterrupted : kExitOk;
  return result.lost > 0 ? kExitFailure : kExitOk;
}

std::string counts(const CopyResult& result, const std::string& place) {
  const auto part = [](std::int64_t count, const std::string& what) {
    return count > 0 ? ", " + std::to_string(count) + what : std::string();
  };
  return std::to_string(result.written) + " frames written to " + place +
         part(result.skipped, " unreadable ones skipped") + part(result.missing - result.dropped, " never arrived") +
         part(result.dropped, " came faster than they could be written") +
         part(result.lost, " lost: " + result.lost_why);
}

/// Finds the folders above an output that do not exist yet. The destructor removes those that are empty.
class NewFolders {
 public:
  explicit NewFolders(const std::string& output) {
    std::error_code ignored;
    fs::path folder = fs::absolute(output, ignored);
    if (!folder.has_filename()) folder = folder.parent_path();  // removes the slash at the end of a path like "folder/"
    for (folder = folder.parent_path(); !folder.empty() && !fs::exists(folder, ignored); folder = folder.parent_path())
      folders_.push_back(folder);
  }
  ~NewFolders() {
    std::error_code not_empty;
    for (const fs::path& folder : folders_) fs::remove(folder, not_empty);
  }
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;

 private:
  std::vector<fs::path> folders_;  // created by this run, innermost first
};

/// Reports to systemd, if it started this program as a service, that the copy makes progress, and its counts every
/// second.
class ServiceReport {
 public:
  ServiceReport(ServiceManager& service, std::string place, const Clock& clock)
      : service_(service), place_(std::move(place)), clock_(clock) {}
  void operator()(const CopyResult& result) {
    service_.alive();
    if (clock_.steady_us() - told_us_ < 1'000'000) return;
    told_us_ = clock_.steady_us();
    service_.status(counts(result, place_));
  }

 private:
  ServiceManager& service_;
  const std::string place_;
  const Clock& clock_;
  std::int64_t told_us_ = 0;
};

}  // namespace

int run_copy(const CopyRequest& request, const std::string& command) {
  const SystemClock clock;
  std::atomic<bool> stop = false;
  std::stop_source stop_waiting;
  ServiceManager service(clock);

  // Let an interrupt end the copying, and also the wait for the reader of a pipe.
  const InterruptWatcher interrupt([&] {
    service.stopping();
    stop = true;
    stop_waiting.request_stop();
  });
  const auto refuse = [&](const Error& error) {
    std::cerr << command << ": " << error.message() << "\n";
    return kExitUsage;
  };

  const Output named = output_of(request, false);
  if (const auto good = check_ending(named, is_file_path(request.out), kFileEndings); !good)
    return refuse(good.error());

  if (request.colour == "raw" && !is_log_path(request.out))
    return refuse({"raw is for LCM logs only", "--colour raw with " + request.out, "take png, which is lossless, too"});

  // Take the sensor's settings from the configuration; what the command line says takes precedence.
  SourceRequest input = request.source;
  if (!request.config.empty()) {
    const auto config = read_configuration(request.config);
    if (!config) return refuse(config.error());
    input.openni2 = config->openni2;
    input.depth = {config->preprocess.min_depth, config->preprocess.max_depth};
    if (!input.foreign.any()) input.foreign = config->foreign_camera;
  }

  if (const auto possible = check(input.foreign); !possible) return refuse(possible.error());
  if (request.source.foreign.any()) input.openni2.camera = request.source.foreign;

  // Open the source.
  auto source = open_source(input, clock);
  if (!source && needs_network(input)) {  // not a usage error
    refuse(source.error());
    return kExitFailure;
  }
  if (!source) return refuse(source.error());
  for (const std::string& warning : source->warnings) std::cerr << command << ": " << warning << "\n";

  // Check that the output replaces nothing that is read or should be kept.
  const FrameWriterOptions written_as = writer_options(request, source->fps, clock);
  const Output output = output_of(request, written_as.rotation.has_value());
  const auto apart = check_outputs(files_of_source(input.spec), {{"--config", config_file(request.config)}}, {output},
                                   request.overwrite);
  if (!apart) return refuse(apart.error());

  // Remove new folders again if they stay empty, and lock the set of logs against other recorders.
  const NewFolders around(request.out);
  std::optional<FileLock> lock;
  if (written_as.rotation && is_log_path(request.out)) {
    auto taken = lock_set(request.out, std::chrono::seconds(3));  // a previous service may be about to end
    if (!taken) {
      refuse(taken.error());
      return kExitFailure;  // not a usage error, since the set may be free later
    }
    lock = std::move(*taken);
  }

  // Opening a pipe would wait for its reader, and could not be stopped.
  PipeReaders readers;
  bool told = false;
  const auto path = readers.wait_for(request.out, PipeReaders::Behind::wait, stop_waiting.get_token(), [&] {
    service.ready("waiting for a reader of " + request.out);
    service.alive();
    if (!std::exchange(told, true))
      std::cerr << command << ": waiting for a program to read the pipe " << request.out << std::endl;
  });

  // Report an empty copy if the user stopped it while it waited.
  const bool live = source->source->live();
  if (!path) {
    CopyResult nothing;
    nothing.stopped = true;
    return exit_code_of(nothing, live, interrupt.signal());
  }

  auto writer = open_frame_writer(request.out, written_as);
  if (!writer) return refuse(writer.error());

  // Copy the frames, and report to the service manager if there is one.
  CopyOptions options;
  options.frames = request.frames;
  options.seconds = request.seconds;
  options.expected = source->frames;
  options.terminal = isatty(STDERR_FILENO) != 0;
  options.quiet = service.present();
  if (service.present()) options.on_step = ServiceReport(service, (*writer)->name(), clock);
  service.ready("recording " + source->source->name());
  CopyResult result = copy_frames(*source->source, **writer, options, stop, clock, std::cerr);

  // Close the file even after an error, so that what was recorded until then is complete.
  Result<void> ended;
  if (result.error) ended = tl::unexpected(*result.error);
  ended = both(std::move(ended), (*writer)->finish());
  if (!ended) result.error = ended.error();
  if (!result.error && !result.stopped) result.error = failure_of(result, source->source->name(), live);
  if (result.error) std::cerr << command << ": " << result.error->message() << "\n";
  std::cerr << command << ": " << counts(result, (*writer)->name()) << (result.stopped ? ", stopped\n" : "\n");
  return exit_code_of(result, live, interrupt.signal());
}

}  // namespace barehand
