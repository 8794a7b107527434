#include "fuzz/check.h"
#include "io/web/view_request.h"

/// Input: a message that the live page sends to the program.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const auto demand = parse_view_demand({reinterpret_cast<const char*>(data), size});
  if (!demand) {
    CHECK(!demand.error().message().empty());
    return 0;
  }
  if (const auto* wish = std::get_if<ViewWish>(&*demand)) {
    CHECK(wish->rate >= 0.1 && wish->rate <= 1000);
    CHECK(wish->window >= 0 && wish->window <= 100);
  }
  return 0;
}
