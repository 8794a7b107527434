#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string_view>

#include "drivers/folder/folder_source.h"
#include "fuzz/check.h"

namespace fs = std::filesystem;

namespace {

/// A folder in memory (/dev/shm), which is used for all inputs.
const std::string& folder() {
  static const std::string path = [] {
    std::string pattern = "/dev/shm/barehand_fuzz_XXXXXX";
    CHECK(mkdtemp(pattern.data()));
    return pattern;
  }();
  static const struct Removal {
    ~Removal() { fs::remove_all(path_); }
    std::string path_;
  } removal{path};
  return path;
}

/// Writes the files that the input contains, each after a line "@NAME", if the name is one of a recording's files.
void write_files(std::string_view input) {
  for (const char* name : {"camera.json", "depth.txt", "rgb.txt", "0.png", "1.png", "0.jpg"}) {
    std::error_code ignored;
    fs::remove(folder() + "/" + name, ignored);
    const std::string line = std::string("@").append(name).append("\n");
    const auto start = input.find(line);
    if (start == std::string_view::npos) continue;
    const auto text = input.substr(start + line.size());
    const auto end = std::min(text.find("\n@"), text.size());
    std::ofstream(folder() + "/" + name, std::ios::binary) << text.substr(0, end);
  }
}

}  // namespace

/// Input: the files of a recording folder, which is played to its end.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  write_files({reinterpret_cast<const char*>(data), size});
  auto source = FolderSource::open(folder(), {});
  if (!source) return 0;
  for (SourceEvent event = Timeout{}; !std::holds_alternative<EndOfStream>(event); event = (*source)->next({}))
    if (const auto* frame = std::get_if<FramePtr>(&event))
      CHECK((*frame)->depth.width() == (*frame)->camera.width && (*frame)->depth.height() == (*frame)->camera.height);
  return 0;
}
