// Parses the requests of Foxglove viewers.
#include "io/web/foxglove_request.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace barehand {
namespace {

using Json = nlohmann::json;

std::optional<std::uint32_t> number(const Json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX) return std::nullopt;
  return value.get<std::uint32_t>();
}

std::optional<std::uint32_t> number_of(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) ? number(json[key]) : std::nullopt;
}

/// The list under a key, empty if there is none.
Json list_of(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_array() ? json[key] : Json::array();
}

}  // namespace

Result<FoxgloveRequest> parse_foxglove_request(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("op") || !json["op"].is_string())
    return fail("this is no message of the protocol");
  const auto op = json["op"].get<std::string>();

  FoxgloveRequest request;
  if (op == "subscribe") {
    // Read which channels are requested, each under a number that the client chose.
    for (const Json& one : list_of(json, "subscriptions")) {
      const auto id = number_of(one, "id"), channel = number_of(one, "channelId");
      if (!id || !channel) return fail("a subscription needs an id and a channelId");
      request.subscribe.push_back({*id, *channel});
    }
  } else if (op == "unsubscribe") {
    // Read the numbers of the subscriptions that end.
    for (const Json& one : list_of(json, "subscriptionIds")) {
      const auto id = number(one);
      if (!id) return fail("a subscription is named by a number");
      request.unsubscribe.push_back(*id);
    }
  } else {
    // Refuse every other operation.
    return fail("the operation " + op + " is not offered: topics can only be read");
  }
  return request;
}

}  // namespace barehand
