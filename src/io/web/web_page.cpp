// Serves the files of the live page.
#include "io/web/web_page.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/data_files.h"

namespace fs = std::filesystem;

namespace barehand {
namespace {

/// The MIME type of a file; empty if such files are not part of a page.
std::string type_of(const fs::path& file) {
  constexpr std::array<std::pair<const char*, const char*>, 4> kTypes = {{{".html", "text/html; charset=utf-8"},
                                                                          {".css", "text/css; charset=utf-8"},
                                                                          {".js", "text/javascript; charset=utf-8"},
                                                                          {".svg", "image/svg+xml"}}};
  for (const auto& [ending, type] : kTypes)
    if (file.extension() == ending) return type;
  return "";
}

bool add(std::map<std::string, WebFile>& files, const std::string& name, const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return false;
  files[name] = {type_of(file), std::string(std::istreambuf_iterator<char>(in), {})};
  return true;
}

}  // namespace

Result<std::map<std::string, WebFile>> read_web_page() {
  std::map<std::string, WebFile> files;
  const auto index = find_data_file("web/index.html");
  if (!index) return tl::unexpected(index.error());
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fs::path(*index).parent_path(), error))
    if (!type_of(entry.path()).empty()) add(files, "/" + entry.path().filename().string(), entry.path());
  if (!files.contains("/index.html")) return fail("cannot read the page", *index, "check the permissions");

  // three.js may be missing; then the page reports it.
  for (const char* name : {"build/three.module.js", "examples/jsm/controls/OrbitControls.js"})
    add(files, std::string("/three/") + name, fs::path(BAREHAND_THREE_DIR) / name);
  return files;
}

}  // namespace barehand
