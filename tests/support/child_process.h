#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <string>
#include <vector>

namespace barehand {

/// A program that runs while the test runs, as a daemon would: without a terminal, with its standard output and error
/// in one pipe.
class ChildProcess {
 public:
  explicit ChildProcess(std::vector<std::string> arguments) {
    // Connect the program's output to a pipe.
    int pipe_ends[2];
    if (pipe2(pipe_ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);

    // Reset the signals' handlers: the tests may run in a shell that ignores some of these signals.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t usual;
    sigemptyset(&usual);
    for (const int number : {SIGHUP, SIGINT, SIGPIPE, SIGTERM}) sigaddset(&usual, number);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);

    // Start the program.
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const int error = posix_spawnp(&pid_, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    close(pipe_ends[1]);
    output_end_ = pipe_ends[0];
    if (error != 0) throw std::runtime_error("cannot start " + arguments[0]);
  }
  ~ChildProcess() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    close(output_end_);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads until the output so far contains `text`. Returns false if the output ends without it.
  bool wait_for(const std::string& text) {
    while (output_.find(text) == std::string::npos)
      if (!read_some()) return false;
    return true;
  }
  /// Waits for more output and reads it. Returns false at the end of the output.
  bool wait_for_more() { return read_some(); }
  pid_t pid() const { return pid_; }
  void signal(int number) { kill(pid_, number); }
  /// Waits for the program's end. Returns its exit code, or 128 + the signal that ended it.
  int finish() {
    while (read_some()) {
    }
    int status = 0;
    rusage used{};
    wait4(pid_, &status, 0, &used);
    peak_memory_ = used.ru_maxrss * 1024;
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  const std::string& output() const { return output_; }
  /// The program's peak memory in RAM [bytes]; call it after finish().
  long peak_memory() const { return peak_memory_; }

 private:
  bool read_some() {
    char buffer[4096];
    const ssize_t count = read(output_end_, buffer, sizeof buffer);
    if (count > 0) output_.append(buffer, static_cast<std::size_t>(count));
    return count > 0;
  }

  pid_t pid_ = -1;
  int output_end_ = -1;
  long peak_memory_ = 0;
  std::string output_;
};

}  // namespace barehand
