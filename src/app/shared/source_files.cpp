// Lists the files that a source reads, so that outputs do not replace them.
#include "app/shared/source_files.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "io/lcm/log_names.h"
#include "io/place.h"
#include "io/recording/stamped_list.h"

namespace barehand {
namespace fs = std::filesystem;
namespace {

void add_recording(const std::string& directory, SourceFiles& files) {
  // Add the files from which a recording is read, even those that do not exist: a result that is written there would
  // later be read as the recording's truth.
  files.folder = directory;
  for (const char* name : {"camera.json", "depth.txt", "rgb.txt", "truth.csv", "truth_left.csv", "truth_right.csv",
                           "fingertips.csv", "fingertips_2d.csv", "start_pose.json", "start_pose_left.json"})
    files.files.push_back(directory + "/" + name);

  // Add the recording's hand profiles that exist; a new one may be written into a recording that has none.
  std::error_code ignored;
  for (const char* name : {"hand.json", "hand_left.json", "hand_right.json"})
    if (const std::string hand = directory + "/" + name; fs::exists(hand, ignored)) files.files.push_back(hand);

  // Add the images, and their folders unless they are in the recording's own folder.
  files.image_folders = {directory + "/depth", directory + "/rgb"};
  for (const char* name : {"depth.txt", "rgb.txt"}) {
    const auto list = read_stamped_list(directory + "/" + name);
    if (!list) continue;

    std::string last;
    for (const StampedFile& image : *list) {
      if (image.file != files.files.back()) files.files.push_back(image.file);
      const std::string folder = image.file.substr(0, image.file.rfind('/'));
      if (folder == last) continue;
      last = folder;
      if (!(Place(folder) == Place(directory))) files.image_folders.push_back(folder);
    }
  }

  // Name each folder once.
  std::sort(files.image_folders.begin(), files.image_folders.end());
  files.image_folders.erase(std::unique(files.image_folders.begin(), files.image_folders.end()),
                            files.image_folders.end());
}

/// Whether a file is an LCM log, by its first bytes and not by its name.
bool is_log(const fs::path& path) {
  constexpr std::array<unsigned char, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  std::array<char, 4> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return std::equal(start.begin(), start.end(), kSync.begin(),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

void add_logs(const std::string& directory, SourceFiles& files) {
  files.folder = directory;
  files.set_of_logs = true;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored))
    if (is_log(entry.path())) files.files.push_back(entry.path().string());
}

}  // namespace

SourceFiles files_of_source(const std::string& spec) {
  SourceFiles files;
  files.name = spec;
  const auto colon = spec.find(':');
  if (colon == std::string::npos) return files;
  const std::string kind = spec.substr(0, colon), path = spec.substr(colon + 1);

  // List the files by the kind of the source; sensors and networks have none.
  std::error_code ignored;
  if (kind == "folder") {
    add_recording(path, files);
  } else if (kind == "log" && fs::is_directory(path, ignored)) {
    add_logs(path, files);
  } else if (kind == "log") {
    if (auto logs = find_logs(path)) files.files = std::move(logs->files);
  } else if (kind == "openni2" && path.ends_with(".oni")) {
    files.files.push_back(path);
  }
  return files;
}

}  // namespace barehand
