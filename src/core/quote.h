#pragma once

#include <string>
#include <string_view>

namespace barehand {

/// "text" with its quotes: names in messages, where spaces and commas would blur them. Control characters, which a
/// terminal would follow, double quotes and back slashes are escaped so that YAML, too, reads it as it was.
std::string in_quotes(std::string_view text);

/// 'text' as one word of a shell's command line, whatever is in it; without quotes where it needs none.
std::string shell_word(std::string_view text);

bool is_utf8(std::string_view text);
/// With U+FFFD in place of every byte that is no UTF-8.
std::string as_utf8(std::string_view text);

}  // namespace barehand
