#include "core/error.h"

namespace barehand {

std::string Error::message() const {
  std::string text;
  if (!where.empty()) text += where + ": ";
  text += what;
  if (!remedy.empty()) text += " (" + remedy + ")";
  return text;
}

tl::unexpected<Error> fail(std::string what, std::string where, std::string remedy) {
  return tl::unexpected<Error>(Error{std::move(what), std::move(where), std::move(remedy)});
}

}  // namespace barehand
