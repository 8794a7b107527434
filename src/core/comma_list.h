#pragma once

#include <string>

namespace barehand {

/// Joins strings or string views to "a, b, c", for messages.
template <class Names>
std::string comma_list(const Names& names) {
  std::string text;
  for (const auto& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

}  // namespace barehand
