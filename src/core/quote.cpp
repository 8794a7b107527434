#include "core/quote.h"

#include <algorithm>

#include "core/format.h"

namespace barehand {

// Quotes texts for messages and command lines, and checks UTF-8.

namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// Length in bytes of the UTF-8 character at the start of `text`, which must not be empty; 0 if there is no valid one.
std::size_t first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < size) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  // Reject overlong encodings, UTF-16 surrogates, and code points beyond U+10FFFF.
  const bool wrong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f) ||
                     (first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) > 0x8f);
  return wrong ? 0 : size;
}

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (is_control(c))
      result += formatted("\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      result.append(c == '"' || c == '\\' ? 1 : 0, '\\').append(1, c);
  }
  return result + "\"";
}

std::string shell_word(std::string_view text) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./:=,+@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string_view::npos) return std::string(text);

  // Choose the quotation with escapes if the text holds control characters.
  const bool controls = std::any_of(text.begin(), text.end(), is_control);
  std::string result = controls ? "$'" : "'";

  // Escape what would end the quotation or would not be visible.
  for (const char c : text) {
    if (is_control(c))
      result += formatted("\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else if (controls)
      result.append(c == '\'' || c == '\\' ? 1 : 0, '\\').append(1, c);
    else if (c == '\'')
      // End the quotation, add the apostrophe with a backslash, and begin a new quotation.
      result += "'\\''";
    else
      result += c;
  }
  return result + "'";
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = first_character(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

std::string as_utf8(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = first_character(text);
    result += size == 0 ? "\xef\xbf\xbd" : text.substr(0, size);
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

}  // namespace barehand
