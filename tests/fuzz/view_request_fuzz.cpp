#include "fuzz/check.h"
#include "io/web/view_request.h"

/// Input: a message that the live page sends to the program.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const auto request = parse_view_request({reinterpret_cast<const char*>(data), size});
  if (!request) {
    CHECK(!request.error().message().empty());
    return 0;
  }
  if (const auto* settings = std::get_if<ViewSettings>(&*request)) {
    CHECK(settings->rate >= 0.1 && settings->rate <= 1000);
    CHECK(settings->window >= 0 && settings->window <= 100);
  }
  return 0;
}
