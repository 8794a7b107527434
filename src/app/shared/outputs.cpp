// Checks that no output of a run replaces one of its inputs or another output.
#include "app/shared/outputs.h"

#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "io/lcm/rotating_log.h"
#include "io/place.h"

namespace barehand {
namespace fs = std::filesystem;
namespace {

constexpr const char* kElsewhere = "choose another name: an input of the run is never replaced";

tl::unexpected<Error> refuse(const Output& output, const std::string& what, const std::string& remedy = kElsewhere) {
  return fail(what, output.option + " " + output.path, remedy);
}

bool is_folder(Output::Kind kind) { return kind == Output::Kind::pictures || kind == Output::Kind::recording; }

bool is_called(const std::string& path, const std::string& name) {
  return path.ends_with(name) && (path.size() == name.size() || path[path.size() - name.size() - 1] == '/');
}

/// Returns which of `files` is the file at `path`; null if none is. A file that exists is identified by its inode,
/// since links to it may have any name. For one that does not exist, only files of its name are compared.
const std::string* same_file(const std::vector<std::string>& files, const std::string& path, const Place& place) {
  struct stat wanted {};
  const bool exists = stat(path.c_str(), &wanted) == 0;
  const auto has_its_inode = [&](const std::string& file) {
    struct stat status {};
    return stat(file.c_str(), &status) == 0 && status.st_dev == wanted.st_dev && status.st_ino == wanted.st_ino;
  };
  const std::string name = fs::path(target_of(path).path).filename().string();
  for (const std::string& file : files)
    if (exists ? has_its_inode(file) : is_called(file, name) && Place(file) == place) return &file;
  return nullptr;
}

Result<void> check_source(const SourceFiles& source, const Output& output, const Place& place) {
  if (const std::string* file = same_file(source.files, output.path, place))
    return refuse(output, "is " + *file + " of the source " + source.name);
  for (const std::string& folder : source.image_folders)
    if (const Place images(folder); place == images || place.lies_in(images))
      return refuse(output, "is or lies in " + folder + ", where images of the source " + source.name + " are",
                    "choose another folder");

  // Refuse a set of logs that contains a log of the source or would add one to the source.
  if (output.kind == Output::Kind::log_set)
    for (const std::string& file : source.files)
      if (belongs_to_set(file, output.path))
        return refuse(output, "names a set of logs that " + file + " of the source belongs to", "choose another name");
  const bool log = output.kind == Output::Kind::log_set || fs::path(output.path).extension() == ".lcmlog";
  if (source.set_of_logs && log && place.is_entry_of(Place(source.folder)))
    return refuse(output, "would become a part of the source " + source.name, "choose another folder");

  // Refuse a recording within the source, whose images could be taken for the source's.
  if (output.kind == Output::Kind::recording && !source.folder.empty() && place.lies_in(Place(source.folder)))
    return refuse(output, "lies in the source " + source.name, "choose a folder elsewhere");

  // Refuse a folder that is the source or contains it.
  if (!is_folder(output.kind)) return {};
  const std::vector<std::string>& whole =
      source.folder.empty() ? source.files : std::vector<std::string>{source.folder};
  for (const std::string& path : whole)
    if (const Place at(path); at == place || at.lies_in(place))
      return refuse(output, "is or contains the source " + source.name, "choose a folder of its own");
  return {};
}

/// Refuses an output folder that holds the images of a recording: --overwrite would delete them, since they are named
/// like the images of an earlier run.
Result<void> check_images(const Output& output, const Place& place) {
  const fs::path folder = fs::path(target_of(output.path).path) / "";
  const std::string recording = folder.parent_path().parent_path().string();
  for (const std::string& images : files_of_source("folder:" + (recording.empty() ? "." : recording)).image_folders)
    if (Place(images) == place)
      return refuse(output, "holds images of the recording " + recording, "choose a folder of its own");
  return {};
}

/// Whether the path is a device or a socket, where writing replaces nothing that can be read.
bool is_endless(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::is_other(status) && !fs::is_fifo(status);
}

/// Whether a name with this ending is one of a file: letters and digits, as many as an ending has.
bool is_ending_of_file(const std::string& ending) {
  constexpr std::size_t kLongest = 9;  // .lcmlog with two letters too many
  const auto is_alphanumeric = [](unsigned char c) { return c == '.' || std::isalnum(c); };
  const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
  return ending.size() <= kLongest && std::ranges::all_of(ending, is_alphanumeric) &&
         std::ranges::any_of(ending, is_letter);
}

bool has_pictures(const std::string& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string stem = entry.path().stem().string(), ending = entry.path().extension().string();
    const bool number =
        !stem.empty() && std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (number && (ending == ".jpg" || ending == ".png")) return true;
  }
  return false;
}

}  // namespace

Result<void> check_ending(const Output& output, bool known, const std::string& endings) {
  const std::string ending = fs::path(output.path).extension().string();
  std::error_code ignored;
  if (known || !is_ending_of_file(ending) || target_of(output.path).direct || fs::is_directory(output.path, ignored))
    return {};
  return refuse(output, "ends in " + ending + ", which is not written here",
                "give a name that ends in " + endings +
                    (is_folder(output.kind) ? ", or " + output.path + "/ for a folder of this name" : ""));
}

bool is_taken(const Output& output) {
  if (output.path.empty() || target_of(output.path).direct) return false;
  if (output.kind == Output::Kind::pictures) return has_pictures(output.path);
  return output.kind == Output::Kind::file && Place(output.path).exists();
}

bool is_standard_output(const std::string& path) {
  if (path.empty()) return false;
  if (target_of(path).descriptor == STDOUT_FILENO) return true;
  struct stat output {
  }, there{};
  if (fstat(STDOUT_FILENO, &output) != 0 || stat(path.c_str(), &there) != 0 || S_ISCHR(output.st_mode)) return false;
  return output.st_dev == there.st_dev && output.st_ino == there.st_ino;
}

Result<void> check_outputs(const SourceFiles& source, const std::vector<InputFile>& inputs,
                           const std::vector<Output>& outputs, bool overwrite) {
  std::vector<std::pair<const Output*, Place>> before;
  for (const Output& output : outputs) {
    if (output.path.empty() || is_endless(output.path)) continue;

    // Compare the place itself, because two names may lead to the same file.
    const Place place(output.path);
    for (const auto& [other, other_place] : before)
      if (place == other_place)
        return refuse(output, "is also written by " + other->option + " " + other->path, "give two names");
    for (const InputFile& input : inputs)
      if (!input.path.empty() && place == Place(input.path))
        return refuse(output, "is the file of " + input.option + " " + input.path);

    // Compare with the files of the source, and protect images that are there already.
    if (const auto apart = check_source(source, output, place); !apart) return apart;
    if (output.kind == Output::Kind::pictures && place.exists())
      if (const auto free = check_images(output, place); !free) return free;
    before.emplace_back(&output, place);
  }

  std::error_code ignored;
  for (const Output& output : outputs) {
    if (output.kind == Output::Kind::file && fs::is_directory(output.path, ignored))
      return refuse(output, "is a folder", "give a file");

    if (!overwrite && is_taken(output))
      return refuse(output, output.kind == Output::Kind::pictures ? "already contains images" : "exists already",
                    "choose another name, or replace it with --overwrite");
  }
  return {};
}

void add_overwrite_option(CLI::App& command, bool& overwrite) {
  command.add_flag("--overwrite", overwrite,
                   "replace existing files; inputs, and recordings in folders, are never replaced");
}

}  // namespace barehand
