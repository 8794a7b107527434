#include "io/stamped_list.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "math/frame_order.h"

namespace barehand {

Result<std::vector<StampedFile>> read_stamped_list(const std::string& path) {
  std::ifstream in(path);
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
    const bool number = error == std::errc{} && end == stamp.data() + stamp.size() && std::isfinite(seconds);
    if (number && std::abs(seconds) * 1e6 > static_cast<double>(kLatestUtime))
      return fail("line " + std::to_string(line) + " has the time stamp " + stamp, path,
                  too_late(seconds, StampUnit::seconds));
    if (!number || !(words >> file))
      return fail("line " + std::to_string(line) + " is \"" + text + "\"", path,
                  "a line holds a time stamp in seconds and a file name");
    files.push_back({std::llround(seconds * 1e6), folder + "/" + file, line});
  }
  return files;
}

}  // namespace barehand
