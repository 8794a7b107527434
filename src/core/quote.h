#pragma once

#include <string>
#include <string_view>

namespace barehand {

/// Puts `text` in double quotes, for names in messages, which may contain spaces and commas. Double quotes, backslashes
/// and control characters (which a terminal would obey) are escaped; YAML reads the result back as `text`.
std::string in_quotes(std::string_view text);

/// Writes `text` as one word of a (bash) command line, in quotes if it needs them.
std::string shell_word(std::string_view text);

bool is_utf8(std::string_view text);
/// Replaces every byte that is not part of valid UTF-8 by U+FFFD.
std::string as_utf8(std::string_view text);

}  // namespace barehand
