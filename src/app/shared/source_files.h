#pragma once

#include <string>
#include <vector>

namespace barehand {

/// The files that a source of frames consists of, which no output may touch.
struct SourceFiles {
  std::string name;                        ///< as the user gave it: "folder:DIR"
  std::string folder;                      ///< a recording or a set of logs; "": a single file, or none
  bool set_of_logs = false;                ///< every log that is put into `folder` belongs to it
  std::vector<std::string> files;          ///< those it has, and those that would belong to it
  std::vector<std::string> image_folders;  ///< of a recording
};

/// `spec` as for --source. Empty for what is no file: a sensor, a network, the simulator. Reads lists, opens no image.
SourceFiles files_of_source(const std::string& spec);

}  // namespace barehand
