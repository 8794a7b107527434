// Parses the requests of Foxglove viewers.
#include "io/foxglove/foxglove_request.h"

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

/// Whether there is a list under a key.
bool has_list(const Json& json, const char* key) { return json.contains(key) && json[key].is_array(); }

}  // namespace

Result<FoxgloveRequest> parse_foxglove_request(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return fail("The message is not valid JSON.");
  if (!json.is_object() || !json.contains("op") || !json["op"].is_string())
    return fail("The message is no JSON object with an operation as its \"op\", such as \"subscribe\".");
  const auto op = json["op"].get<std::string>();

  FoxgloveRequest request;
  if (op == "subscribe") {
    // Read which channels are requested, each under a number that the client chose.
    if (!has_list(json, "subscriptions"))
      return fail("The operation subscribe needs the list \"subscriptions\", such as [{\"id\": 1, \"channelId\": 3}].");
    for (const Json& one : json["subscriptions"]) {
      const auto id = number_of(one, "id"), channel = number_of(one, "channelId");
      if (!id || !channel)
        return fail("A subscription needs an \"id\" and a \"channelId\", both whole numbers from 0 to 4294967295.");
      request.subscribe.push_back({*id, *channel});
    }
  } else if (op == "unsubscribe") {
    // Read the numbers of the subscriptions that end.
    if (!has_list(json, "subscriptionIds"))
      return fail("The operation unsubscribe needs the list \"subscriptionIds\", such as [1].");
    for (const Json& one : json["subscriptionIds"]) {
      const auto id = number(one);
      if (!id) return fail("An id in \"subscriptionIds\" is no whole number from 0 to 4294967295.");
      request.unsubscribe.push_back(*id);
    }
  } else {
    // Refuse every other operation.
    return fail("The operation \"" + op + "\" is not offered; only subscribe and unsubscribe are.");
  }
  return request;
}

}  // namespace barehand
