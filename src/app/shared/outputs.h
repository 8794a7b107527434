#pragma once

#include <string>
#include <vector>

#include "app/shared/source_files.h"
#include "core/error.h"

namespace CLI {
class App;
}

namespace barehand {

// A check that outputs of a run replace none of its inputs.

/// A file that a run reads besides its source.
struct InputFile {
  std::string option;  ///< such as "--hand"
  std::string path;    ///< "": none
};

/// A file or folder that a run writes.
struct Output {
  enum class Kind {
    file,
    pictures,   ///< a folder with one image per frame
    recording,  ///< a folder that becomes a recording; its writer checks what the folder contains
    log_set,    ///< a set of logs whose names begin with the name in `path` (RotatingLog)
  };
  std::string option;  ///< such as "--result"
  std::string path;    ///< "": not written
  Kind kind = Kind::file;
};

/// Call it before the first output is opened. Refuses an output
/// - that is an input or another output, even under another name (Place);
/// - that is a file of the source, lies in one of its image folders, or as a folder is or contains the source. A new
///   file or folder of images next to the files of a recording is allowed;
/// - that is a recording and lies in the folder of the source;
/// - that is a folder of images and holds images of a recording;
/// - that exists, unless `overwrite`. A folder of images counts as existing if it contains images of frames.
/// Devices are never refused; pipes and descriptors are refused only if they are an input or another output.
Result<void> check_outputs(const SourceFiles& source, const std::vector<InputFile>& inputs,
                           const std::vector<Output>& outputs, bool overwrite);

/// Refuses a path with the ending of a file that is not `known`, since a mistyped ending would make a folder, or a file
/// that other programs take for something else. `endings` says which are known. A name without an ending, with a number
/// for one (take.2), or with a slash at its end is never refused; nor is a folder that exists, a pipe or a device.
Result<void> check_ending(const Output& output, bool known, const std::string& endings);

/// Whether check_outputs refuses the output because it exists, so that --overwrite would help.
bool is_taken(const Output& output);

/// Whether `path` is the standard output, by any name. If so, a command prints to standard error what it would
/// otherwise print to standard output.
bool is_standard_output(const std::string& path);

/// Adds --overwrite, which is the same for every command.
void add_overwrite_option(CLI::App& command, bool& overwrite);

}  // namespace barehand
