// Parses the requests of the live page.
#include "io/web/view_request.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace barehand {
namespace {

using nlohmann::json;
constexpr const char* kWhere = "message of a client";

/// The position of `message[key]` among `names`; 0 if there is no such key.
Result<int> choice_of(const json& message, const char* key, std::initializer_list<const char*> names) {
  const std::string wanted = message.value(key, *names.begin());
  std::string list;
  int position = 0;
  for (const char* name : names) {
    if (wanted == name) return position;
    list.append(list.empty() ? "" : ", ").append(name);
    ++position;
  }
  return fail(std::string("no such ") + key, kWhere, "ask for one of " + list);
}

Result<ViewRequest> settings_of(const json& message) {
  ViewSettings settings;

  // Read what shall be shown.
  const auto cloud = choice_of(message, "cloud", {"none", "hand", "scene"});
  if (!cloud) return tl::unexpected(cloud.error());
  settings.cloud = static_cast<ViewCloud>(*cloud);
  const auto picture = choice_of(message, "picture", {"none", "colour", "depth"});
  if (!picture) return tl::unexpected(picture.error());
  settings.picture = static_cast<ViewPicture>(*picture);

  // Read the size and the rate of what is sent.
  settings.large = message.value("large", settings.large);
  settings.rate = message.value("rate", settings.rate);
  if (!(settings.rate >= 0.1 && settings.rate <= 1000)) return fail("rate is out of range", kWhere, "give 0.1 to 1000");

  // Read how many frames may be unacknowledged.
  settings.window = message.value("window", settings.window);
  if (settings.window < 0 || settings.window > 100) return fail("window is out of range", kWhere, "give 0 to 100");
  return settings;
}

Result<ViewRequest> record_of(const json& message) {
  if (!message.contains("on") || message.size() > 2)
    return fail("a command to record holds nothing but \"on\"", kWhere, "send {\"type\": \"record\", \"on\": true}");
  return RecordCommand{message.at("on").get<bool>()};
}

std::optional<PlayerCommand::Kind> player_kind(const std::string& type) {
  using Kind = PlayerCommand::Kind;
  constexpr std::array<std::pair<const char*, Kind>, 6> kKinds = {{{"play", Kind::play},
                                                                   {"pause", Kind::pause},
                                                                   {"seek", Kind::seek},
                                                                   {"step", Kind::step},
                                                                   {"speed", Kind::speed},
                                                                   {"lost", Kind::lost}}};
  for (const auto& [name, kind] : kKinds)
    if (type == name) return kind;
  return std::nullopt;
}

Result<ViewRequest> request_of(const json& message) {
  const std::string type = message.at("type");
  if (type == "want") return settings_of(message);
  if (type == "ack") return ViewAcknowledge{};
  if (type == "record") return record_of(message);
  const auto kind = player_kind(type);
  if (!kind) return fail("unknown type", kWhere, "give want, ack, record, play, pause, seek, step, speed or lost");
  const double value = message.value("value", 0.0);
  if (!(std::abs(value) <= 1e9)) return fail("value is out of range", kWhere, "give a number");
  return PlayerCommand{*kind, value};
}

}  // namespace

Result<ViewRequest> parse_view_request(std::string_view text) {
  // A client may send anything; the exceptions of nlohmann's JSON parser say what is wrong.
  try {
    return request_of(json::parse(text));
  } catch (const json::exception& error) {
    return fail(error.what(), kWhere, "send JSON as docs/view_protocol.md says");
  }
}

}  // namespace barehand
