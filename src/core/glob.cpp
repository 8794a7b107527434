// Matches names with patterns that contain `*` and `?`.
#include "core/glob.h"

namespace barehand {

bool matches_glob(std::string_view glob, std::string_view name) {
  std::size_t at = 0, in_name = 0;
  auto star = std::string_view::npos;  // position of the last '*' in the glob
  // Where in `name` the part of the glob after that '*' is being matched.
  std::size_t tried = 0;

  // Match one character of the name after the other.
  while (in_name < name.size()) {
    if (at < glob.size() && glob[at] == '*') {
      star = at++;
      tried = in_name;
    } else if (at < glob.size() && (glob[at] == '?' || glob[at] == name[in_name])) {
      ++at, ++in_name;
    } else if (star != std::string_view::npos) {
      // Let the last '*' cover one character more, and match the rest again.
      at = star + 1;
      in_name = ++tried;
    } else {
      return false;
    }
  }

  // The name is used up, so only stars may be left of the pattern.
  return glob.find_first_not_of('*', at) == std::string_view::npos;
}

std::string glob_to_regex(const std::string& glob) {
  std::string regex;
  for (const char c : glob) {
    if (c == '*') {
      regex += ".*";
    } else if (c == '?') {
      regex += '.';
    } else {
      if (std::string_view(".^$|()[]{}+\\").find(c) != std::string_view::npos) regex += '\\';
      regex += c;
    }
  }
  return regex;
}

}  // namespace barehand
