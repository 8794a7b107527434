// Runs `barehand view`, which shows the states of another tracker, or a log, on the live page.
#include "app/view/view_run.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>

#include "app/shared/exit_code.h"
#include "app/shared/interrupt.h"
#include "app/shared/run_inputs.h"
#include "app/shared/standard_streams.h"
#include "app/view/live_view.h"
#include "app/view/log_index.h"
#include "app/view/log_player.h"
#include "core/log.h"
#include "io/web/view_server.h"

namespace barehand {
namespace {

constexpr const char* kPortOption = "--port PORT";

/// A profile for each side: the one given by the user, or the mean adult hand.
Result<ShownHands> shown_hands(const std::vector<std::string>& wanted) {
  std::array<std::shared_ptr<const HandProfile>, 2> profiles;
  std::array<std::string, 2> drawn;
  for (const auto& names : {std::vector<std::string>{"both"}, wanted}) {
    if (names.empty()) continue;
    const auto hands = choose_hands(names, {});
    if (!hands) return tl::unexpected(hands.error());
    for (const NamedHand& hand : *hands) {
      const auto side = static_cast<std::size_t>(hand.profile->handedness);
      profiles[side] = hand.profile;
      drawn[side] = hand.profile->origin == ProfileOrigin::mean ? "" : hand.name;
    }
  }
  ShownHands shown(profiles, drawn);
  shown.prepare();
  return shown;
}

/// What the user has chosen for the display: the skins of the hands, and the pose of the camera in the room.
struct Shown {
  ShownHands hands;
  std::optional<SE3> T_world_camera;
};

Result<Shown> shown_of(const ViewOptions& options) {
  const auto hands = shown_hands(options.hands);
  if (!hands) return tl::unexpected(hands.error());
  if (options.config.empty()) return Shown{*hands, {}};
  return read_configuration(options.config)
      .and_then([](const Config& config) { return world_from(config.world); })
      .map([&](const std::optional<SE3>& world) {
        return Shown{*hands, world};
      });
}

/// Plays a log until `stop`; commands of clients come from other threads.
class LogShow {
 public:
  LogShow(LogIndex index, std::string name, Shown shown, const Clock& clock)
      : index_(std::move(index)),
        name_(std::move(name)),
        shown_(std::move(shown)),
        clock_(clock),
        position_(make_position(index_)) {}

  void follow(const PlayerCommand& command) {
    const std::lock_guard lock(mutex_);
    position_.follow(command, clock_.steady_us());
    commanded_ = true;
    changed_.notify_all();
  }
  void run(ViewServer& server, const std::atomic<bool>& stop);

 private:
  static LogPosition make_position(const LogIndex& index) {
    std::vector<double> seconds;
    for (std::int64_t i = 0; i < index.frames(); ++i) seconds.push_back(index.seconds(i));
    return {std::move(seconds), index.lost()};
  }

  LogIndex index_;
  const std::string name_;
  Shown shown_;
  SteadyRange depths_;
  const Clock& clock_;
  std::mutex mutex_;  // protects the members below
  std::condition_variable changed_;
  LogPosition position_;
  bool commanded_ = false;
};

void LogShow::run(ViewServer& server, const std::atomic<bool>& stop) {
  constexpr std::int64_t kPatienceUs = 50'000;  // longest wait, which limits the time that stopping takes
  std::int64_t told_us = 0;                     // time of the last status
  std::unique_lock lock(mutex_);
  while (!stop) {
    if (!server.has_clients() && !stop) {  // wait, since playing starts when a page connects
      changed_.wait_for(lock, std::chrono::microseconds(kPatienceUs));
      position_.wait(clock_.steady_us());
      continue;
    }
    const std::int64_t begin_us = clock_.steady_us();
    const bool moved = position_.advance(begin_us);
    const bool tell = moved || commanded_ || begin_us - told_us >= kStatusPeriodUs;  // clients take silence for the end
    if (tell) told_us = begin_us;
    const PlayedLog state = position_.state();
    commanded_ = false;

    // Reading and showing take a while, during which commands may arrive.
    lock.unlock();
    if (moved) {
      ViewFrame::Content content =
          frame_content(index_.messages(state.position), shown_.hands, {}, index_.image(state.position));
      content.T_world_camera = shown_.T_world_camera;
      content.place = {state.position, state.at};
      if (content.frame) content.depths = depths_.follow(typical_range(*content.frame), content.utime);
      server.show(std::make_shared<const ViewFrame>(std::move(content)));
    }
    if (tell)
      server.show_status(status_json(
          {name_, false, "", server.clients(), {}, state, shown_.T_world_camera, {}, {}, shown_.hands.names()}));
    lock.lock();

    const std::int64_t now_us = clock_.steady_us();
    const std::int64_t wait_us = std::min(position_.due_us().value_or(now_us + kPatienceUs) - now_us, kPatienceUs);
    if (!commanded_ && wait_us > 0) changed_.wait_for(lock, std::chrono::microseconds(wait_us));
  }
}

int view_logs(const ViewOptions& options, const WebAddress& address, Shown shown, const std::atomic<bool>& stop) {
  auto index = LogIndex::open(options.logs);
  if (!index) return failed("view", index.error(), kExitUsage);
  for (const std::string& warning : index->warnings()) std::cerr << "barehand view: " << warning << "\n";
  std::string name;
  for (const std::string& log : options.logs) name.append(name.empty() ? "log:" : ", ").append(log);
  const SystemClock clock;
  LogShow show(std::move(*index), name, std::move(shown), clock);
  auto server = ViewServer::start(
      {address, options.origins, [&](const PlayerCommand& c) { show.follow(c); }, nullptr, kPortOption}, clock);
  if (!server) return failed("view", server.error(), kExitFailure);
  std::cerr << "open " << (*server)->url() << " in a browser to see the log; Ctrl-C ends\n";
  show.run(**server, stop);
  return kExitOk;
}

int view_network(const ViewOptions& options, const WebAddress& address, Shown shown, const std::atomic<bool>& stop) {
  auto bus = LcmBus::open(options.lcm_url);
  if (!bus) return failed("view", bus.error(), LcmBus::is_network(options.lcm_url) ? kExitFailure : kExitUsage);
  const SystemClock clock;
  constexpr std::size_t kWaiting = 120;  // messages that may wait for the recorder; a frame has about four
  std::unique_ptr<LogRecorder> recorder;
  if (!options.record.empty())
    recorder = std::make_unique<LogRecorder>(LogRecorder::Options{options.record, kWaiting}, make_logger(), clock);
  auto server = ViewServer::start({address, options.origins, {}, recorder.get(), kPortOption}, clock);
  if (!server) return failed("view", server.error(), kExitFailure);
  std::cerr << "open " << (*server)->url() << " in a browser to see what comes on " << (*bus)->url()
            << "; Ctrl-C ends\n";
  LiveView live(std::move(*bus), {options.prefix, shown.T_world_camera, recorder.get()}, std::move(shown.hands),
                **server, clock);
  while (!stop && !live.broken()) live.step(std::chrono::milliseconds(20));
  return live.broken() ? failed("view", {"the LCM connection broke", options.lcm_url, "start again"}, kExitFailure)
                       : kExitOk;
}

}  // namespace

int run_view(const ViewOptions& options) {
  std::atomic<bool> stop = false;
  const InterruptWatcher interrupt([&stop] { stop = true; });
  if (options.lcm != options.logs.empty())
    return failed("view", {"nothing to show", "", "give logs, or --lcm, but not both"}, kExitUsage);
  if (!options.record.empty()) {
    if (!options.lcm)
      return failed("view", {"records what comes live", "--record", "give --lcm instead of a log"}, kExitUsage);
    if (const auto good = LogRecorder::check_folder(options.record); !good)
      return failed("view", good.error(), kExitUsage);
  }
  const auto address = parse_web_address(options.port);
  if (!address) return failed("view", address.error(), kExitUsage);
  auto shown = shown_of(options);
  if (!shown) return failed("view", shown.error(), kExitUsage);
  const int code = options.lcm ? view_network(options, *address, std::move(*shown), stop)
                               : view_logs(options, *address, std::move(*shown), stop);
  return code == kExitOk && interrupt.signal() == SIGINT ? kExitInterrupted : code;
}

}  // namespace barehand
