#pragma once

#include <string>

namespace barehand {

/// "a, b, c" of strings or string views, for messages.
template <class Names>
std::string comma_list(const Names& names) {
  std::string text;
  for (const auto& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

}  // namespace barehand
