#include "io/file_bytes.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace barehand {

Result<std::string> read_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return fail("is a folder", path, "give a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail("cannot be read", path, "check that the file exists and is readable");
  try {
    return std::string(std::istreambuf_iterator<char>(file), {});
  } catch (const std::ios_base::failure& error) {
    return fail(std::string("cannot be read: ") + error.what(), path);
  }
}

bool is_missing(const std::string& path) {
  std::error_code error;
  return !std::filesystem::exists(path, error) && !error;
}

}  // namespace barehand
