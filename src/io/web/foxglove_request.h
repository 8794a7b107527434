#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace barehand {

/// What a viewer asks for: channels, each under a number of its own, and numbers that it wants no more.
struct FoxgloveRequest {
  struct Subscription {
    std::uint32_t id = 0, channel = 0;
  };
  std::vector<Subscription> subscribe;
  std::vector<std::uint32_t> unsubscribe;
};

/// Parses {"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 3}]} and {"op": "unsubscribe",
/// "subscriptionIds": [1]}. Errors: no JSON, another operation, numbers that are none.
Result<FoxgloveRequest> parse_foxglove_request(std::string_view text);

}  // namespace barehand
