#include <algorithm>
#include <optional>
#include <string>

#include "fuzz/memory_file.h"
#include "io/recording/stamped_list.h"

namespace {

std::optional<std::vector<barehand::StampedFile>> list_of(const std::string& text) {
  const barehand::fuzz::MemoryFile file(text.data(), text.size());
  const auto list = barehand::read_stamped_list(file.path());
  return list ? std::optional(*list) : std::nullopt;
}

/// The text as an editor under Windows writes it, with a byte order mark and carriage returns.
std::string with_mark_and_carriage_returns(const std::string& text) {
  std::string windows = "\xef\xbb\xbf";
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return windows;
}

/// The list as a text without comments, with every name in quotes.
std::string plain(const std::vector<barehand::StampedFile>& list) {
  std::string text;
  for (const auto& [utime, file, line] : list)
    text += std::to_string(static_cast<double>(utime) * 1e-6) + " \"" + file + "\"\n";
  return text;
}

}  // namespace

/// Input: a file depth.txt or rgb.txt. It must give the same list when written as under Windows and as by plain().
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto list = list_of(text);

  // A byte order mark and carriage returns must not change the result.
  const bool marks = text.starts_with("\xef\xbb\xbf") || text.find('\r') != std::string::npos;
  const bool wide = text.size() > 1 && (text[0] == '\0' || text[1] == '\0' || text.starts_with("\xff\xfe") ||
                                        text.starts_with("\xfe\xff"));
  if (!marks && !wide) {
    const auto same = list_of(with_mark_and_carriage_returns(text));
    CHECK(same.has_value() == list.has_value());
    CHECK(!list || std::equal(list->begin(), list->end(), same->begin(), same->end(), [](const auto& a, const auto& b) {
      return a.utime == b.utime && a.file == b.file && a.line == b.line;
    }));
  }
  if (!list) return 0;

  // Check the entries.
  bool quotable = true;
  int line = 0;
  for (const auto& entry : *list) {
    CHECK(!entry.file.empty() && entry.line > line);
    CHECK(entry.file.find_first_of("\n\r") == std::string::npos);
    line = entry.line;
    quotable &= entry.file.find('"') == std::string::npos;
    barehand::is_outside("/proc/self/fd", entry.file);
  }
  if (!quotable) return 0;

  // The entries must give the same files if they are written to a list again.
  const auto again = list_of(plain(*list));
  CHECK(again && again->size() == list->size());
  for (std::size_t i = 0; i < list->size(); ++i) CHECK((*again)[i].file == (*list)[i].file);
  return 0;
}
