#pragma once

#include <string>
#include <tl/expected.hpp>

namespace barehand {

/// An error caused by the outside world: what happened, where (file:line, URL, device) and what the user can do.
struct Error {
  std::string what;
  std::string where;
  std::string remedy;

  /// One line for the user: "where: what (remedy)".
  std::string message() const;
};

/// A value, or the error that prevented it.
template <typename T>
using Result = tl::expected<T, Error>;

/// Use: `return fail("depth is 320x240, camera.json says 640x480", path, "fix width and height");`
tl::unexpected<Error> fail(std::string what, std::string where = {}, std::string remedy = {});

}  // namespace barehand
