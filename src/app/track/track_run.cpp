// Runs `barehand track`: opens all inputs and outputs, tracks, and reports the result.
#include "app/track/track_run.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <iostream>
#include <stop_token>

#include "app/shared/exit_code.h"
#include "app/shared/interrupt.h"
#include "app/shared/pipe_readers.h"
#include "app/shared/run_inputs.h"
#include "app/shared/source_factory.h"
#include "app/shared/standard_streams.h"
#include "app/track/track_outputs.h"
#include "core/memory/available_memory.h"
#include "core/memory/kept_memory.h"
#include "core/parallel/parallel.h"
#include "hand/profile_warnings.h"
#include "io/data_files.h"
#include "io/file_bytes.h"
#include "io/hand/pose_json.h"
#include "pipeline/config.h"
#include "pipeline/pipeline.h"
#include "pipeline/progress.h"
#include "pipeline/reload.h"
#include "pipeline/service_manager.h"
#include "pipeline/sinks/file_sinks.h"
#include "pipeline/sinks/health_sink.h"
#include "pipeline/sinks/mcap_sink.h"
#include "pipeline/sinks/publish_sink.h"
#include "pipeline/sinks/service_sink.h"
#include "pipeline/sinks/view_sink.h"
#include "pipeline/summary.h"
#include "pipeline/track_stages.h"
#include "stages/publish/publisher.h"
#include "tracking/memory_check.h"

namespace barehand {
namespace {

using Step = tl::expected<void, TrackFailure>;

tl::unexpected<TrackFailure> usage(const Error& error) { return tl::unexpected(TrackFailure{error, kExitUsage}); }
tl::unexpected<TrackFailure> failure(const Error& error) { return tl::unexpected(TrackFailure{error, kExitFailure}); }

// What the live page says while a recording waits for Workers::run_in_background(), which tracking uses for this only.
constexpr const char* kScanning =
    "The person's hand is being scanned from the frames so far, and the recording waits for the result. That takes ten "
    "seconds, or longer on a busy processor.";
constexpr double kUsualRate = 30;  // frame rate of a video if that of the source is not known [Hz]

/// One run, which is set up step by step: all input is checked before the first output file is touched.
class TrackRun {
 public:
  TrackRun(const TrackOptions& options, const Config& config, std::function<Result<Config>()> reread,
           std::vector<std::unique_ptr<Sink>> more, std::function<ViewScan()> scan, ObjectWatcher watch_objects)
      : options_(options),
        config_(config),
        reread_(std::move(reread)),
        scan_(std::move(scan)),
        watch_objects_(std::move(watch_objects)),
        log_(make_logger(), clock_),
        reload_(config, pending_),
        interrupt_([this] { stop(); }, reread_ ? [this] { reload(); } : std::function<void()>()),
        sinks_(std::move(more)) {}

  Step prepare();
  TrackOutcome run();

 private:
  Step open_input();
  Step use_hands();
  Step use_objects();
  Step choose_start();
  Step choose_outputs();
  Step open_outputs();
  Step await_readers();
  Step open_bus();
  Step open_mcap();
  Step open_view();
  CommandedTracker::Inbox inbox() const;
  template <class Open>
  auto connect(Open open, bool live) -> decltype(open());
  TrackFailure no_network(const Error& error) const;
  tl::unexpected<TrackFailure> stopped(const std::string& when) const;
  void stop();
  void reload();
  Result<Reload::Changes> exchange_configuration();
  Step add(Result<std::unique_ptr<Sink>> sink);
  /// Nominal rate of the frames that are played [Hz]; `unknown`: the rate to assume if the source states none.
  double rate(double unknown) const {
    return (input_.fps > 0 ? input_.fps : unknown) / std::abs(static_cast<double>(options_.step));
  }
  PipelineHealth with_view(PipelineHealth health) const;
  Farewell farewell(const RunResult& result) const;
  int conclude(const RunResult& result);
  int exit_code_of_frames(const PipelineHealth& health);

  TrackOptions options_;
  const Config& config_;
  const std::function<Result<Config>()> reread_;
  const std::function<ViewScan()> scan_;
  const ObjectWatcher watch_objects_;
  SystemClock clock_;
  RepeatLog log_;
  RepeatLog waiting_{log_.shared_logger(), clock_, kWaitingIntervalUs, kWaitingGrowth};
  ServiceManager service_{clock_};
  std::stop_source stop_;
  PendingParams pending_;
  Reload reload_;               // used by the watcher's thread only
  InterruptWatcher interrupt_;  // declared before anything that starts threads
  std::unique_ptr<Workers> workers_;
  OpenSource input_;
  TwoHandTracker::Profiles profiles_;
  std::vector<KnownObjectPtr> objects_;
  std::optional<HandPose> initial_;
  std::optional<SE3> world_;  // T_world_camera; none: the pose of the camera in the room is not known
  std::shared_ptr<LcmBus> bus_;
  std::unique_ptr<CommandInbox> commands_;
  PipeReaders readers_;
  std::unique_ptr<LivePage> page_;  // null: it was not requested, or its server could not be started
  std::vector<std::unique_ptr<Sink>> sinks_;
  ProgressSink* progress_ = nullptr;
  std::unique_ptr<Pipeline> pipeline_;
};

Step TrackRun::prepare() {
  auto workers = make_workers(options_.threads);
  if (!workers) return usage(workers.error());
  workers_ = std::move(*workers);

  // Check what needs no source first, so that a mistake is reported before a sensor starts.
  if (const auto named = Publisher::create(config_.run.channel_prefix, {}); !named) return usage(named.error());
  if (const auto fits = check_memory(config_.tracker, available_memory()); !fits) return usage(fits.error());
  if (const auto possible = check(config_.foreign_camera); !possible) return usage(possible.error());
  const auto world = world_from(config_.world);
  if (!world) return usage(world.error());
  world_ = *world;
  if (const auto good = LivePage::check(options_); !good) return usage(good.error());

  // Open the source, and prepare everything that depends on it.
  return open_input()
      .and_then([&] { return use_hands(); })
      .and_then([&] { return use_objects(); })
      .and_then([&] { return choose_start(); })
      .and_then([&] { return choose_outputs(); })
      .and_then([&] { return open_outputs(); });
}

Step TrackRun::open_input() {
  // Describe the wanted source by the command line and the configuration.
  SourceRequest request;
  request.spec = options_.source;
  request.start = options_.start;
  request.step = options_.step;
  request.lcm_url = options_.lcm_url;
  request.channel = config_.run.frame_channel;
  request.foreign = config_.foreign_camera;
  request.openni2 = config_.openni2;
  request.depth = {config_.preprocess.min_depth, config_.preprocess.max_depth};

  // Open it. If it needs the network, wait until the network is available.
  const bool from_network = needs_network(request);
  auto input = connect([&] { return open_source(request, clock_); }, from_network);
  if (!input) return from_network ? tl::unexpected(no_network(input.error())) : usage(input.error());
  input_ = std::move(*input);

  // Adapt the run to a live source or to a recording, and repeat the warnings of the source.
  if (input_.source->live())
    workers_->go_live();
  else
    interrupt_.stop_on_hangup();  // no reload, since the configuration must not change within a recording
  for (const std::string& warning : input_.warnings) log_.logger().warn(warning);
  return {};
}

Step TrackRun::use_hands() {
  const auto hands = choose_hands(options_.hands, input_);
  if (!hands) return usage(hands.error());
  for (const NamedHand& hand : *hands) {
    log_.logger().info("hand profile: {}", hand.name);
    for (const std::string& warning : profile_warnings(*hand.profile)) log_.logger().warn("{}: {}", hand.name, warning);
  }
  profiles_ = profiles_of(*hands);
  return {};
}

Step TrackRun::use_objects() {
  auto objects = load_objects(options_.objects, log_.logger());
  if (!objects) return usage(objects.error());
  objects_ = std::move(*objects);
  return {};
}

Step TrackRun::choose_start() {
  if (options_.init == "auto") return {};
  auto pose = load_pose(options_.init, *profiles_[0]);
  if (!pose) return usage(pose.error());
  initial_ = *pose;
  return {};
}

Step TrackRun::choose_outputs() {
  auto resolved =
      resolve_outputs(options_, find_config(options_.config).value_or(""), profiles_, input_.source->live());
  if (!resolved) return usage(resolved.error());
  const auto tell = [&](const std::string& wanted, const std::string& chosen) {
    if (wanted != chosen) log_.logger().info("{} exists already, writing {}", wanted, chosen);
  };
  for (const auto file : TrackOptions::kFiles) tell(options_.*file, (*resolved).*file);
  tell(options_.overlay, resolved->overlay);
  options_ = std::move(*resolved);
  return {};
}

Step TrackRun::add(Result<std::unique_ptr<Sink>> sink) {
  if (!sink) return failure(sink.error());
  sinks_.push_back(std::move(*sink));
  return {};
}

Step TrackRun::await_readers() {
  const auto wait = [&](const std::string& path, PipeReaders::Behind behind) {
    return readers_.wait_for(path, behind, stop_.get_token(), [&] {
      waiting_.warn("reader of " + path, "waiting for a program to read the pipe " + path);
      service_.ready("waiting for a reader of " + path);
      service_.alive();
    });
  };

  // The pipe of a file is opened here and passed on by its descriptor.
  for (const auto file : TrackOptions::kFiles) {
    std::string& path = options_.*file;
    const bool patient = !input_.source->live() || file == &TrackOptions::save_hand;  // the hand is saved at the end
    const auto opened = wait(path, patient ? PipeReaders::Behind::wait : PipeReaders::Behind::leave_out);
    if (!opened) return stopped("stopped while waiting for a reader of " + path);
    if (*opened != path) log_.logger().info("the pipe {} is written as {}", path, *opened);
    path = *opened;
  }

  // A video keeps its name, whose ending says the format.
  if (!options_.overlay.empty() && !wait(options_.overlay, PipeReaders::Behind::wait))
    return stopped("stopped while waiting for a reader of " + options_.overlay);
  return {};
}

Step TrackRun::open_outputs() {
  Step ok = await_readers();
  if (!ok) return ok;

  // Open the outputs that the user named, until one cannot be opened.
  const std::string& prefix = config_.run.channel_prefix;
  if (!options_.no_publish) ok = open_bus();
  if (ok && !options_.result.empty()) ok = add(ResultTableSink::create(options_.result, profiles_, options_.overwrite));
  if (ok && !options_.states_log.empty())
    ok = add(
        StatesLogSink::create(config_.publish, prefix, options_.states_log, options_.overwrite, &pending_.states_log));
  if (ok && !options_.mcap.empty()) ok = open_mcap();
  if (ok && !options_.decisions.empty()) ok = add(DecisionSink::create(options_.decisions, options_.overwrite));

  // Open those that show the hand or keep its profile.
  if (ok && !options_.overlay.empty())
    ok = add(OverlaySink::create(options_.overlay, rate(kUsualRate), options_.overlay_every, options_.overwrite,
                                 options_.overlay_names ? SegmentNames::drawn : SegmentNames::left_out));
  if (ok && !options_.save_hand.empty()) ok = add(SaveHandSink::create(options_.save_hand, profiles_));
  if (ok && options_.view) ok = open_view();
  if (!ok) return ok;

  // Add the sinks that report to the service manager and to the terminal.
  if (service_.present())
    sinks_.push_back(std::make_unique<ServiceSink>(
        service_, [this] { return pipeline_->heartbeat(); }, [this] { return pipeline_->health(); },
        [this] { return progress_->statuses(); }, clock_));
  if (options_.health)
    sinks_.push_back(std::make_unique<HealthSink>(
        std::cerr, [this] { return pipeline_->health(); }, static_cast<std::int64_t>(config_.run.health_period * 1e6),
        clock_));

  // Show the progress last, when all other sinks have consumed the frame.
  auto progress = std::make_unique<ProgressSink>(
      std::cerr,
      ProgressSink::Options{isatty(STDERR_FILENO) == 1 && !options_.health, input_.frames, service_.present(),
                            config_.publish, &pending_.progress},
      clock_);
  progress_ = progress.get();
  sinks_.push_back(std::move(progress));
  return {};
}

Step TrackRun::open_bus() {
  auto bus = connect([&] { return LcmBus::open(options_.lcm_url, config_.run.lcm_ttl); }, input_.source->live());
  if (!bus) {
    bus.error().remedy += "; --no-publish tracks without publishing";
    return tl::unexpected(no_network(bus.error()));
  }

  // Accept commands from other programs.
  bus_ = std::move(*bus);
  if (config_.run.commands) {
    commands_ = std::make_unique<CommandInbox>(bus_, config_.run.channel_prefix + "COMMAND");
    log_.logger().info("following commands on {}COMMAND", config_.run.channel_prefix);
  }

  // Publish the hands, what is found about them, and, at a regular interval, the health of the pipeline.
  BusSink::Health health{[this] { return with_view(pipeline_->take_interval_health()); },
                         static_cast<std::int64_t>(config_.run.health_period * 1e6), input_.source->name()};
  auto hands =
      BusSink::create(config_.publish, config_.run.channel_prefix, *bus_, std::move(health), clock_, &pending_.bus);
  if (!hands) return failure(hands.error());
  auto findings = std::make_unique<FindingsSink>(**hands);
  sinks_.push_back(std::move(*hands));
  sinks_.push_back(std::move(findings));
  return {};
}

Step TrackRun::open_mcap() {
  McapSink::Input input{rate(0), input_.source->live(), [this] { return with_view(pipeline_->health()); },
                        input_.source->name(), world_};
  return add(
      McapSink::create(config_.publish, options_.mcap, options_.overwrite, std::move(input), clock_, &pending_.mcap));
}

/// Calls `open`, which needs the LCM network. If that fails, a live run waits until the network is available.
template <class Open>
auto TrackRun::connect(Open open, bool live) -> decltype(open()) {
  std::mutex mutex;
  std::condition_variable_any never;
  while (true) {
    auto opened = open();
    if (opened || !live || !LcmBus::is_network(options_.lcm_url) || stop_.stop_requested()) return opened;
    if (LcmBus::open(options_.lcm_url)) return open();  // the network is available, or the error has another cause
    waiting_.warn("LCM", opened.error().message() + "; trying again every second");
    service_.ready("waiting for the LCM network");
    service_.alive();
    std::unique_lock lock(mutex);
    never.wait_for(lock, stop_.get_token(), std::chrono::seconds(1), [] { return false; });
  }
}

/// Starts the server of the live page. The page is optional: if the server cannot be started, tracking continues
/// without.
Step TrackRun::open_view() {
  // The page is only a view: tracking continues if the page cannot be served.
  auto page = LivePage::open(options_, log_.shared_logger());
  if (!page) {
    log_.logger().error("{}; tracking goes on without the page", page.error().message());
    return {};
  }
  page_ = std::move(*page);

  // Give the hands to the page, and add the sink that sends it every frame.
  for (const auto& profile : profiles_) page_->server().set_profile(profile);
  ViewSink::Input input{input_.source->name(),
                        input_.source->live(),
                        [this] { return pipeline_->health(); },
                        world_,
                        scan_,
                        config_.run.channel_prefix,
                        page_->recorder(),
                        input_.if_silent};
  input.held_up_by = [this] { return workers_->does_long_work() ? std::string(kScanning) : std::string(); };
  sinks_.push_back(
      std::make_unique<ViewSink>(config_.publish, page_->server(), std::move(input), clock_, &pending_.view));
  return {};
}

/// Adds the live page's queue of frames to the health of the pipeline.
PipelineHealth TrackRun::with_view(PipelineHealth health) const {
  if (page_) health.queues.push_back(page_->server().health());
  return health;
}

TrackFailure TrackRun::no_network(const Error& error) const {
  // A network may come up later; another URL that cannot be opened now never can.
  if (!stop_.stop_requested()) return {error, LcmBus::is_network(options_.lcm_url) ? kExitFailure : kExitUsage};
  return stopped("stopped while waiting for the LCM network").value();
}

/// The result of a run that was stopped before its first frame.
tl::unexpected<TrackFailure> TrackRun::stopped(const std::string& when) const {
  const bool done = interrupt_.signal() != SIGINT && (!input_.source || input_.source->live());
  return tl::unexpected(TrackFailure{{when, "", ""}, done ? kExitOk : kExitInterrupted});
}

void TrackRun::stop() {
  service_.stopping();
  stop_.request_stop();
}

void TrackRun::reload() {
  service_.reloading();
  const auto changes = exchange_configuration();
  if (!changes) {
    log_.logger().error("configuration not reloaded, the old one stays in force: {}", changes.error().message());
    return service_.ready("configuration not reloaded: " + changes.error().what);
  }
  for (const std::string& change : changes->made) log_.logger().info("changed {}", change);
  for (const std::string& change : changes->for_restart)
    log_.logger().warn("takes effect only after a restart: {}", change);
  log_.logger().info("configuration reloaded, {} values changed", changes->made.size());
  service_.ready("configuration reloaded");
}

Result<Reload::Changes> TrackRun::exchange_configuration() {
  const auto config = reread_();
  if (!config) return tl::unexpected(config.error());
  if (auto fits = check_memory(config->tracker, available_memory()); !fits) return tl::unexpected(fits.error());
  return reload_.apply(*config);
}

CommandedTracker::Inbox TrackRun::inbox() const {
  if (!commands_) return {};
  return [commands = commands_.get()] { return commands->take(); };
}

TrackOutcome TrackRun::run() {
  // Connect the stages to the source and the sinks.
  TrackStages computing =
      make_track_stages(config_, profiles_, initial_, inbox(), *workers_, log_, &pending_, objects_, watch_objects_);
  PipelineStages stages{*input_.source,
                        std::move(computing.preprocess),
                        std::move(computing.track),
                        {},
                        std::move(computing.contact),
                        std::move(computing.grasp)};
  for (const auto& sink : sinks_) stages.sinks.push_back(sink.get());

  // Set how the pipeline runs, and tell the user what starts.
  PipelineOptions options;
  options.threaded = !options_.single_threaded;
  options.max_failures_in_a_row = config_.run.max_failures_in_a_row;
  options.stop = stop_.get_token();
  log_.logger().info("tracking {}, {} threads{}", input_.source->name(), workers_->threads(),
                     options.threaded ? "" : ", stages inline");
  if (page_) log_.logger().info("open {} in a browser to see the hand; Ctrl-C ends", page_->server().url());

  // Run until the source ends or the user stops it.
  pipeline_ = std::make_unique<Pipeline>(std::move(stages), std::move(options), clock_, log_);
  service_.ready("tracking " + input_.source->name());
  const std::int64_t start = clock_.steady_us();
  const RunResult result = pipeline_->run();
  const double seconds = static_cast<double>(clock_.steady_us() - start) * 1e-6;
  if (page_) page_->server().set_farewell(farewell(result));
  return {with_view(result.health), progress_->counts(), seconds, result.stopped, conclude(result), std::move(page_)};
}

/// What the live page says at the end. A live run that was stopped or failed may be started again.
Farewell TrackRun::farewell(const RunResult& result) const {
  const bool live = input_.source->live();
  const int code = live ? Farewell::kStopped : Farewell::kDone;
  const std::string frames = options_.source.starts_with("sim:") ? "simulation" : live ? "source" : "recording";
  if (result.error) return {code, "Tracking has ended with an error, which the program's output names."};
  if (result.stopped)
    return live ? Farewell() : Farewell{code, "Barehand was stopped before the end of the " + frames + "."};
  return {Farewell::kDone,
          "The " + frames + " has ended; " + std::to_string(result.health.published) + " frames were tracked."};
}

int TrackRun::conclude(const RunResult& result) {
  int exit_code = kExitOk;
  if (result.stopped) {
    const bool by_user = interrupt_.signal() == SIGINT;
    log_.logger().info("stopped by {}; everything tracked until then is written", interrupt_.name());
    if (by_user || !input_.source->live()) exit_code = kExitInterrupted;  // the recording was not tracked to its end
  }

  // Report outputs that are incomplete, and the error that ended the run.
  for (const std::string& sink : result.incomplete) {
    log_.logger().error("{}: frames are missing", sink);
    if (!input_.source->live()) exit_code = kExitFailure;  // a live run does not fail because of a disk or the network
  }

  if (result.error) {
    log_.logger().error(result.error->message());
    exit_code = kExitFailure;
  }
  return exit_code == kExitOk ? exit_code_of_frames(result.health) : exit_code;
}

/// The exit code of a run that reached its end. Reports if most frames of a recording could not be used, and if no hand
/// was found in any frame.
int TrackRun::exit_code_of_frames(const PipelineHealth& health) {
  // A recording fails if none of its frames could be used, or fewer than half of them.
  const std::int64_t frames = health.captured + health.skipped, unusable = health.skipped + health.failed;
  if (!input_.source->live() && health.published == 0) {
    log_.logger().error("{}: nothing was tracked: of {} frames {} could not be read and {} failed; nothing is written",
                        input_.source->name(), frames, health.skipped, health.failed);
    return kExitFailure;
  }

  if (!input_.source->live() && 2 * unusable > frames) {
    log_.logger().error("{}: most frames are missing: of {} frames {} could not be read and {} failed",
                        input_.source->name(), frames, health.skipped, health.failed);
    return kExitFailure;
  }

  // A run without any hand is not a failure, but the user may have expected a hand.
  const auto tracked = [](const StatusCounts& hand) { return hand.of(TrackStatus::tracking) > 0; };
  if (const auto& hands = progress_->counts(); health.published > 0 && std::ranges::none_of(hands, tracked))
    log_.logger().warn(
        "no hand was found in any of {} frames: is one in view, between {:.3g} and {:.3g} m away, and are the unit of "
        "depth and the intrinsics right?",
        health.published, config_.preprocess.min_depth, config_.preprocess.max_depth);
  return kExitOk;
}

Result<Config> configuration(const TrackOptions& options) {
  auto config = read_configuration(options.config);
  if (config && options.seed) config->run.seed = *options.seed;
  return config;
}

ConfigKeys keys_named(const std::string& name) {
  if (name == "all") return ConfigKeys::all;
  return name == "changed" ? ConfigKeys::changed : ConfigKeys::user;
}

}  // namespace

tl::expected<TrackOutcome, TrackFailure> track(const TrackOptions& options, const Config& config,
                                               std::function<Result<Config>()> reread,
                                               std::vector<std::unique_ptr<Sink>> more, std::function<ViewScan()> scan,
                                               ObjectWatcher watch_objects) {
  TrackRun run(options, config, std::move(reread), std::move(more), std::move(scan), std::move(watch_objects));
  if (const Step prepared = run.prepare(); !prepared) return tl::unexpected(prepared.error());
  return run.run();
}

int run_track(const TrackOptions& given) {
  // A file that is gone at a reload must not be taken for a shipped one of the same name.
  TrackOptions options = given;
  if (const auto path = find_config(given.config)) options.config = std::filesystem::absolute(*path);
  const auto config = configuration(options);
  if (!config) return failed("track", config.error(), kExitUsage);
  if (!options.print_config.empty()) {
    std::cout << print_config(*config, keys_named(options.print_config));
    return printed(kExitOk);
  }
  if (options.source.empty())
    return failed("track", {"no --source", "", "give folder:DIR, log:FILE, lcm, openni2 or sim:NAME"}, kExitUsage);
  keep_freed_memory();

  // In a terminal, SIGHUP means that the terminal was closed. Without one, it reloads the configuration.
  const bool daemon = isatty(STDIN_FILENO) == 0;
  const auto reread = [&]() -> Result<Config> {
    if (is_pipe(options.config))
      return fail("was a pipe, which cannot be read again", options.config, "start with a file to change it later");
    return configuration(options);
  };

  // Track. The summary must not mix with results that are written to the standard output.
  std::ostream& told = writes_to_standard_output(options) ? std::cerr : std::cout;
  const auto outcome = track(options, *config, daemon ? reread : std::function<Result<Config>()>());
  if (!outcome) return failed("track", outcome.error().error, outcome.error().exit_code);
  told << summary(outcome->health, outcome->status, outcome->seconds) << std::flush;
  return outcome->exit_code;
}

}  // namespace barehand
