#include "io/stamped_list.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/file_bytes.h"
#include "io/whole_file.h"

namespace barehand {

Result<std::vector<StampedFile>> read_stamped_list(const std::string& path) {
  std::ifstream in(path);
  if (!in && !is_missing(path + std::string(kUnfinished)))
    return fail("is missing: the recording was not finished", path,
                "rename " + path + std::string(kUnfinished) + " to play it as far as it got");
  if (!in) return fail("cannot be read", path, "a recording needs it, see docs/formats.md");
  const std::string folder = std::filesystem::path(path).parent_path().string();
  std::vector<StampedFile> files;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    std::istringstream words(text.substr(0, text.find('#')));
    std::string stamp, file;
    if (!(words >> stamp)) continue;
    double seconds = 0;
    const auto [end, error] = std::from_chars(stamp.data(), stamp.data() + stamp.size(), seconds);
    const bool number = error == std::errc{} && end == stamp.data() + stamp.size() && std::abs(seconds) < 9e12;
    if (!number || !(words >> file))
      return fail("line " + std::to_string(line) + " is \"" + text + "\"", path,
                  "a line holds a time stamp in seconds and a file name");
    files.push_back({std::llround(seconds * 1e6), folder + "/" + file, line});
  }
  return files;
}

}  // namespace barehand
