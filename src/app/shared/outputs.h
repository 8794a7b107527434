#pragma once

#include <string>
#include <vector>

#include "app/shared/source_files.h"
#include "core/error.h"

namespace CLI {
class App;
}

namespace barehand {

/// A file that a run reads besides its source.
struct InputFile {
  std::string option;  ///< "--hand"
  std::string path;    ///< "": none
};

/// What a run writes.
struct Output {
  enum class Kind {
    file,
    pictures,   ///< a folder with a picture a frame
    recording,  ///< a folder that becomes a recording, which looks after itself what is there
    log_set,    ///< logs whose names begin with this one's (RotatingLog)
  };
  std::string option;  ///< "--result"
  std::string path;    ///< "": not written
  Kind kind = Kind::file;
};

/// To be asked before the first output is opened. Refuses an output
/// - that is an input or another output, whatever it is called (Place);
/// - that is a file of the source, lies in one of its image folders, or as a folder is or contains the source. A new
///   file or folder beside the files of a recording is none of these;
/// - that is a folder of pictures and holds images of a recording;
/// - that exists, unless `overwrite`. A folder of pictures exists where there are pictures of frames in it.
/// Devices are never refused, and pipes and descriptors only where they are an input or another output.
Result<void> check_outputs(const SourceFiles& source, const std::vector<InputFile>& inputs,
                           const std::vector<Output>& outputs, bool overwrite);

/// Whether check_outputs refuses it because of what is there, and --overwrite would help.
bool is_taken(const Output& output);

/// Whether it goes where the standard output goes, by whatever name. Then nothing else belongs there: a command tells
/// people on standard error what it would print.
bool is_standard_output(const std::string& path);

/// --overwrite, the same for every command.
void add_overwrite_option(CLI::App& command, bool& overwrite);

}  // namespace barehand
