#include "fuzz/check.h"
#include "io/foxglove/foxglove_request.h"

/// Input: a message that a viewer such as Foxglove sends.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const auto request = parse_foxglove_request({reinterpret_cast<const char*>(data), size});
  if (request)
    CHECK(request->subscribe.size() + request->unsubscribe.size() <= size);
  else
    CHECK(!request.error().message().empty());
  return 0;
}
