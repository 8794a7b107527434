// Serves the live page and its data, and executes the users' requests.
#include "io/web/view_server.h"

#include <thread>

#include "io/web/web_page.h"

namespace barehand {

Result<std::unique_ptr<ViewServer>> ViewServer::start(Options options, const Clock& clock) {
  // Read the files of the page, and make the server that the handlers refer to.
  auto page = read_web_page();
  if (!page) return tl::unexpected(page.error());
  std::unique_ptr<ViewServer> server(new ViewServer(options, clock));

  // Set the address and the files.
  WebServer::Options web;
  web.address = options.address.address;
  web.port = options.address.port;
  web.port_option = options.port_option;
  web.allowed_origins = std::move(options.allowed_origins);
  web.files = std::move(*page);

  // Accept clients of the live page and of Foxglove; the latter may also ask for a URDF.
  web.connect = [self = server.get()](WebSocket socket) { return self->connect(socket); };
  web.protocols.assign(std::begin(kFoxgloveProtocols), std::end(kFoxgloveProtocols));
  web.connect_protocol = [self = server.get()](WebSocket socket) { return self->foxglove_.connect(socket); };
  web.made_file = [self = server.get()](const std::string& path, const std::string& base) {
    return self->foxglove_.urdf(path, base);
  };

  // Start to listen only when everything is in place.
  auto started = WebServer::start(std::move(web));
  if (!started) return tl::unexpected(started.error());
  server->web_ = std::move(*started);
  return server;
}

namespace {
/// Waits until `done` returns true, but no longer than `patience`.
void wait_until(const std::function<bool()>& done, std::chrono::milliseconds patience) {
  constexpr std::int64_t kStepMs = 5;
  for (std::int64_t ms = 0; ms < patience.count() && !done(); ms += kStepMs)
    std::this_thread::sleep_for(std::chrono::milliseconds(kStepMs));
}
}  // namespace

ViewServer::~ViewServer() {
  if (!web_) return;
  pages_.end(farewell_);
  foxglove_.end(farewell_);

  // A connection that the server cut off could lose what the client has not read yet, so wait for the clients.
  constexpr std::chrono::seconds kPatience{1};
  wait_until([&] { return !has_clients(); }, kPatience);
}

std::unique_ptr<WebPeer> ViewServer::connect(WebSocket socket) {
  ViewClient::Handlers handlers;
  handlers.play = [this](const PlayerCommand& command) { return play(command); };
  handlers.record = [this, number = ++last_client_](const RecordCommand& command) { return record(command, number); };
  handlers.gone = [this](FrameClient& gone) { pages_.forget(gone); };
  auto client = std::make_unique<ViewClient>(socket, clock_, std::move(handlers));
  pages_.add(*client);
  return client;
}

/// Hands a command for the log on. The error is sent to the client that gave the command.
Result<void> ViewServer::play(const PlayerCommand& command) {
  if (!on_command_) return fail("no log is played here", "view", "play a log with barehand view LOG to move in it");
  on_command_(command);
  return {};
}

/// Starts or stops a recording. The error is sent to the client that gave the command.
Result<void> ViewServer::record(const RecordCommand& command, int client) {
  if (!recorder_) return fail("nothing can be recorded here", "view", "start the program with a folder for recordings");
  if (command.on) return recorder_->start(client);
  recorder_->stop(client);
  return {};
}

void ViewServer::show(const ViewFramePtr& frame) {
  foxglove_.show(frame);
  pages_.show(frame);
}

void ViewServer::show_status(std::string json) {
  pages_.show_status(std::make_shared<const std::string>(std::move(json)));
}

void ViewServer::flush(std::chrono::milliseconds patience) const {
  wait_until([&] { return pages_.are_told(); }, patience);
}

QueueHealth ViewServer::health() const {
  QueueHealth all;
  all.name = "view";
  pages_.add_health(all);
  foxglove_.add_health(all);
  return all;
}

}  // namespace barehand
