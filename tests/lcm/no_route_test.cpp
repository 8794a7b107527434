// Tests the error message in a network without any route. To be started by without_multicast.sh.
#include <gtest/gtest.h>

#include "io/lcm/lcm_bus.h"

namespace barehand {
namespace {

TEST(NoRoute, ConnectingFailsAndSaysHowToMendIt) {
  const auto bus = LcmBus::open("");
  ASSERT_FALSE(bus);
  EXPECT_NE(bus.error().message().find("ip route add 224.0.0.0/4 dev lo"), std::string::npos) << bus.error().message();
}

}  // namespace
}  // namespace barehand
