#pragma once

#include <string>
#include <string_view>

namespace barehand {

/// Puts `text` in double quotes, for names in messages, which may contain spaces and commas. Double quotes, backslashes
/// and control characters (which a terminal would obey) are escaped; YAML reads the result back as `text`.
std::string in_quotes(std::string_view text);

/// Writes `text` as one word of a (bash) command line, in quotes if it needs them.
std::string shell_word(std::string_view text);

/// Joins strings or string views to "a, b, c", for messages.
template <class Names>
std::string comma_list(const Names& names) {
  std::string text;
  for (const auto& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

bool is_utf8(std::string_view text);
/// Replaces every byte that is not part of valid UTF-8 by U+FFFD.
std::string as_utf8(std::string_view text);

}  // namespace barehand
