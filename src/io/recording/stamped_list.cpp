// Reads the lists of images and time stamps of a recording (depth.txt and rgb.txt).
#include "io/recording/stamped_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>

#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "sensor/frame_order.h"

namespace barehand {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kSpaces = " \t\v\f";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kSpaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpaces) + 1 - first);
}

/// The text before the '#' that begins a comment.
std::string_view without_comment(std::string_view text) {
  for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1))
    if (at == 0 || kSpaces.find(text[at - 1]) != std::string_view::npos) return text.substr(0, at);
  return text;
}

std::optional<double> seconds_in(std::string_view word) {
  double seconds = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), seconds);
  const bool number = error == std::errc{} && end == word.data() + word.size() && std::isfinite(seconds);
  return number ? std::optional(seconds) : std::nullopt;
}

bool has_digit(std::string_view word) {
  return std::any_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The path of the file that the text after a time stamp names; none if it names none.
std::optional<std::string> file_in(std::string_view rest, const fs::path& folder) {
  const auto path_of = [&](std::string_view name) { return (folder / name).string(); };

  // A name in quotation marks is taken literally.
  if (rest.starts_with('"')) {
    const auto quote = rest.find('"', 1);
    if (quote == std::string_view::npos || quote == 1) return std::nullopt;
    if (!trimmed(without_comment(rest.substr(quote + 1))).empty()) return std::nullopt;
    return path_of(rest.substr(1, quote - 1));
  }

  // List the possible names, the most literal first, and take the first one that exists. A single name need not exist.
  std::vector<std::string> names{std::string(trimmed(without_comment(rest)))};
  if (names[0].empty()) return std::nullopt;

  // Also try the name with the separators of Windows replaced, and each name up to its first space.
  if (names[0].find('\\') != std::string::npos) {
    names.push_back(names[0]);
    std::replace(names[1].begin(), names[1].end(), '\\', '/');
  }
  for (std::size_t i = 0, whole = names.size(); i < whole; ++i)
    if (const auto space = names[i].find_first_of(kSpaces); space != std::string::npos)
      names.push_back(names[i].substr(0, space));

  // Choose among several possible names by what exists.
  if (names.size() > 1)
    for (const std::string& name : names)
      if (std::error_code ignored; fs::exists(folder / name, ignored)) return path_of(name);
  return path_of(names[0].find('\\') == std::string::npos ? names[0] : names[1]);
}

}  // namespace

Result<std::vector<StampedFile>> read_stamped_list(const std::string& path) {
  // Read the list, or explain that the recording was not finished.
  auto text = read_text(path);
  if (!text && !is_missing(path + std::string(kUnfinished)))
    return fail("is missing: the recording was not finished", path,
                "rename " + path + std::string(kUnfinished) + " to play it as far as it got");
  if (!text) return tl::unexpected(text.error());

  // Read line by line; names are relative to the folder of the list.
  const fs::path folder = fs::path(path).parent_path();
  std::istringstream lines(std::move(*text));
  std::vector<StampedFile> files;
  bool first = true;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    // Skip comments, and a first line that is a header.
    const std::string_view content = trimmed(line);
    if (content.empty() || content[0] == '#') continue;
    const std::string_view word = content.substr(0, content.find_first_of(kSpaces));
    if (std::exchange(first, false) && !has_digit(word)) continue;

    const auto seconds = seconds_in(word);
    if (seconds && std::abs(*seconds) * 1e6 > static_cast<double>(kLatestUtime))
      return fail("line " + std::to_string(number) + " has the time stamp " + std::string(word), path,
                  too_late(*seconds, StampUnit::seconds));

    // Read the name of the file.
    const auto file = seconds ? file_in(trimmed(content.substr(word.size())), folder) : std::nullopt;
    if (!file)
      return fail("line " + std::to_string(number) + " is \"" + line + "\"", path,
                  "a line holds a time stamp in seconds, a space and a file name");
    files.push_back({std::llround(*seconds * 1e6), *file, number});
  }
  return files;
}

bool is_outside(const std::string& folder, const std::string& file) {
  if (file.starts_with(folder + "/") && file.find("..") == std::string::npos) return false;
  const fs::path within =
      fs::absolute(file).lexically_normal().lexically_relative(fs::absolute(folder + "/").lexically_normal());
  return within.empty() || within == ".." || within.string().starts_with("../");
}

}  // namespace barehand
