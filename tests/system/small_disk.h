#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/child_process.h"

namespace barehand {

/// A disk of 2 MiB, of which a file takes 1.9 MiB. It is mounted on a folder, for one child process only.
class SmallDisk {
 public:
  explicit SmallDisk(std::string folder) : folder_(std::move(folder)) {}

  static bool possible() { return ChildProcess({"unshare", "-rm", "true"}).finish() == 0; }
  /// The arguments that run a program with that disk.
  std::vector<std::string> command(const std::vector<std::string>& program) const {
    std::string script =
        "mount -t tmpfs -o size=2m tmpfs " + folder_ + " && head -c 1900000 /dev/zero > " + ballast_ + " && exec";
    for (const std::string& argument : program) script += " '" + argument + "'";
    return {"unshare", "-rm", "sh", "-c", script};
  }
  /// Runs a shell script that sees the same disk as the child; returns its output.
  std::string beside(const ChildProcess& child, const std::string& script) const {
    ChildProcess helper(
        {"nsenter", "--preserve-credentials", "-U", "-m", "-t", std::to_string(child.pid()), "sh", "-c", script});
    EXPECT_EQ(helper.finish(), 0) << helper.output();
    return helper.output();
  }
  void make_room(const ChildProcess& child) const { beside(child, "rm " + ballast_); }

 private:
  const std::string folder_;
  const std::string ballast_ = folder_ + "/ballast";
};

}  // namespace barehand
