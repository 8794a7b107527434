// Parses the requests of the live page.
#include "io/web/view_request.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>

#include "core/quote.h"
#include "io/hand/json_fields.h"

namespace barehand {
namespace {

using json_fields::Object;
constexpr const char* kWhere = "message of a client";

/// Refuses keys that do not belong to a message of this type, since a misspelled wish would be ignored.
Result<void> check_keys(const Object& message, std::initializer_list<const char*> known) {
  for (const auto& [key, value] : message.json.items()) {
    if (key == "type" || std::ranges::find(known, key) != known.end()) continue;
    return fail("unknown key " + json_fields::shown(key), kWhere,
                known.size() == 0 ? "give nothing but the type" : "besides the type there may be " + comma_list(known));
  }
  return {};
}

/// The position of `message[key]` among `names`; 0 if there is no such key.
Result<int> choice_of(const Object& message, const char* key, std::initializer_list<const char*> names) {
  const auto wanted = message.has(key) ? message.text(key) : Result<std::string>(*names.begin());
  if (!wanted) return tl::unexpected(wanted.error());
  int position = 0;
  for (const char* name : names) {
    if (*wanted == name) return position;
    ++position;
  }
  return fail(std::string("no such ") + key, kWhere, "ask for one of " + comma_list(names));
}

Result<ViewRequest> settings_of(const Object& message) {
  if (const auto good = check_keys(message, {"cloud", "picture", "large", "rate", "window"}); !good)
    return tl::unexpected(good.error());
  ViewSettings settings;

  // Read what shall be shown.
  const auto cloud = choice_of(message, "cloud", {"none", "hand", "scene"});
  if (!cloud) return tl::unexpected(cloud.error());
  settings.cloud = static_cast<ViewCloud>(*cloud);
  const auto picture = choice_of(message, "picture", {"none", "colour", "depth"});
  if (!picture) return tl::unexpected(picture.error());
  settings.picture = static_cast<ViewPicture>(*picture);

  // Read the size and the rate of what is sent.
  const auto large = message.has("large") ? message.boolean("large") : Result<bool>(settings.large);
  if (!large) return tl::unexpected(large.error());
  settings.large = *large;
  const auto rate = message.number_or("rate", settings.rate, 0.1, 1000);
  if (!rate) return tl::unexpected(rate.error());
  settings.rate = *rate;

  // Read how many frames may be unacknowledged.
  const auto window = message.number_or("window", settings.window, 0, 100);
  if (!window) return tl::unexpected(window.error());
  if (*window != std::floor(*window)) return fail("window is no whole number", kWhere, "give 0 to 100");
  settings.window = static_cast<int>(*window);
  return settings;
}

Result<ViewRequest> record_of(const Object& message) {
  return check_keys(message, {"on"}).and_then([&] { return message.boolean("on"); }).map([](bool on) -> ViewRequest {
    return RecordCommand{on};
  });
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

Result<ViewRequest> player_command(const Object& message, PlayerCommand::Kind kind) {
  using Kind = PlayerCommand::Kind;
  if (kind == Kind::play || kind == Kind::pause)
    return check_keys(message, {}).map([&]() -> ViewRequest { return PlayerCommand{kind, 0}; });

  // The other commands need a number: a frame, a number of frames, a direction or a factor.
  const double most = kind == Kind::speed ? 100 : kind == Kind::lost ? 1 : 1e9;
  const double least = kind == Kind::speed ? 0.01 : kind == Kind::seek ? 0 : -most;
  return check_keys(message, {"value"})
      .and_then([&] { return message.number("value", least, most); })
      .map([&](double value) -> ViewRequest {
        return PlayerCommand{kind, value};
      });
}

Result<ViewRequest> request_of(const Object& message) {
  const auto type = message.text("type");
  if (!type) return tl::unexpected(type.error());
  if (*type == "want") return settings_of(message);
  if (*type == "ack") return check_keys(message, {}).map([]() -> ViewRequest { return ViewAcknowledge{}; });
  if (*type == "record") return record_of(message);
  const auto kind = player_kind(*type);
  if (!kind) return fail("unknown type", kWhere, "give want, ack, record, play, pause, seek, step, speed or lost");
  return player_command(message, *kind);
}

}  // namespace

Result<ViewRequest> parse_view_request(std::string_view text) {
  const auto json = json_fields::parse_json(std::string(text), kWhere);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object())
    return fail("is no JSON object", kWhere, "send an object with a \"type\", such as {\"type\": \"want\"}");
  return request_of({*json, kWhere});
}

}  // namespace barehand
