// Reads whole files and pipes into memory.
#include "io/file_bytes.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <string_view>

namespace barehand {
namespace fs = std::filesystem;
namespace {

Result<std::string> read_stream(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail("cannot be read", path, "check that the file exists and is readable");
  try {
    return std::string(std::istreambuf_iterator<char>(file), {});
  } catch (const std::ios_base::failure& error) {
    return fail(std::string("cannot be read: ") + error.what(), path);
  }
}

/// Reads until the end, but at most kMost bytes, since a device may never end.
Result<std::string> read_pipe(const std::string& path) {
  constexpr std::streamsize kMost = 64 << 20;
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail("cannot be read", path, "check that it exists and is readable");
  std::string text;
  for (char block[1 << 16]; file.read(block, sizeof block) || file.gcount() > 0;) {
    text.append(block, static_cast<std::size_t>(file.gcount()));
    if (static_cast<std::streamsize>(text.size()) > kMost)
      return fail("delivers more than 64 MiB", path, "give a file, or a pipe that ends");
  }
  return text;
}

/// Reads every pipe once and keeps its content, since a pipe can be read only once.
class PipesRead {
 public:
  Result<std::string> read(const std::string& path) {
    const std::lock_guard lock(mutex_);
    if (const auto known = texts_.find(path); known != texts_.end()) return known->second;
    auto text = read_pipe(path);
    if (text) texts_[path] = *text;
    return text;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> texts_;
};

/// Looks at the first two bytes: a text in our formats begins with two ASCII characters.
bool looks_like_utf16(std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) return true;
  return text.size() >= 2 && (text[0] == '\0') != (text[1] == '\0');
}

/// Replaces "\r\n" and a lone "\r" by "\n".
std::string with_plain_line_ends(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r')
      plain += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      plain += '\n';
  }
  return plain;
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
  static PipesRead pipes;
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return fail("is a folder", path, "give a file");
  return is_pipe(path) ? pipes.read(path) : read_stream(path);
}

Result<std::string> read_text(const std::string& path) {
  auto text = read_file(path);
  if (!text) return text;
  if (looks_like_utf16(*text)) return fail("is UTF-16, or not a text file", path, "save it as UTF-8");
  if (text->starts_with("\xef\xbb\xbf")) text->erase(0, 3);  // the byte order mark, which Windows programs write
  return text->find('\r') == std::string::npos ? text : with_plain_line_ends(*text);
}

bool is_pipe(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && fs::is_other(path, ignored);
}

bool is_missing(const std::string& path) {
  std::error_code error;
  return !fs::exists(path, error) && !error;
}

}  // namespace barehand
