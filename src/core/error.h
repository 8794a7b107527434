#pragma once

#include <string>
#include <tl/expected.hpp>

namespace barehand {

/// An outside condition that went wrong: what happened, where (file:line, URL, device) and what the user can do.
struct Error {
  std::string what;
  std::string where;
  std::string remedy;

  /// One line for people: "where: what (remedy)".
  std::string message() const;
};

template <typename T>
using Result = tl::expected<T, Error>;

/// `return fail("depth is 320x240, camera.json says 640x480", path, "fix width and height");`
tl::unexpected<Error> fail(std::string what, std::string where = {}, std::string remedy = {});

}  // namespace barehand
