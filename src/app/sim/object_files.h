#pragma once

#include <string>
#include <vector>

#include "drivers/synthetic/synthetic_source.h"
#include "io/row_file.h"

namespace barehand {

/// The files about a grasped object (docs/formats.md): its mesh, its pose and the class of the grasp in every frame,
/// and how near each segment of each hand is to it.
class ObjectFiles {
 public:
  /// Paths of the files, as far as one sequence has them.
  struct Paths {
    std::string mesh, poses, grasps;
    std::vector<std::string> contacts;  ///< path of every hand's table
  };

  /// Creates the files. `overwrite`: existing ones are replaced.
  static Result<ObjectFiles> create(const Paths& paths, const synthetic::SyntheticSource& source, bool overwrite);
  /// Writes what belongs to the frame that was delivered last.
  Result<void> write(const synthetic::SyntheticSource& source, std::int64_t utime);
  Result<void> finish();

 private:
  ObjectFiles(std::string name, RowFile poses, RowFile grasps, std::vector<RowFile> contacts)
      : name_(std::move(name)), poses_(std::move(poses)), grasps_(std::move(grasps)), contacts_(std::move(contacts)) {}

  std::string name_;
  RowFile poses_, grasps_;
  std::vector<RowFile> contacts_;
};

}  // namespace barehand
