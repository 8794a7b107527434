#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace barehand {

/// A request of a viewer.
struct FoxgloveRequest {
  struct Subscription {
    std::uint32_t id = 0, channel = 0;  ///< the viewer chooses `id`
  };
  std::vector<Subscription> subscribe;
  std::vector<std::uint32_t> unsubscribe;  ///< ids of subscriptions
};

/// Parses {"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 3}]} and {"op": "unsubscribe",
/// "subscriptionIds": [1]}. Errors: invalid JSON, another operation, ids that are not unsigned 32-bit numbers.
Result<FoxgloveRequest> parse_foxglove_request(std::string_view text);

}  // namespace barehand
