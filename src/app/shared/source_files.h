#pragma once

#include <string>
#include <vector>

namespace barehand {

/// The files that a source of frames consists of, which no output may touch.
struct SourceFiles {
  std::string name;                        ///< as the user gave it, such as "folder:DIR"
  std::string folder;                      ///< a recording or a set of logs; "": a single file, or none
  bool set_of_logs = false;                ///< whether every log that is put into `folder` belongs to the source
  std::vector<std::string> files;          ///< files of the source, and those that would belong to it if they existed
  std::vector<std::string> image_folders;  ///< folders with the images of a recording
};

/// The files of the source `spec` (as for --source); empty for a sensor, a network and the simulator. Reads the lists
/// of a recording but no images.
SourceFiles files_of_source(const std::string& spec);

}  // namespace barehand
