// Opens standard streams that are closed, so that no output file gets their file descriptors.
#include "app/shared/standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "app/shared/exit_code.h"

namespace barehand {

void prepare_standard_streams() {
  // Open what is closed. open() returns the lowest free number, which is `descriptor`, since those below it are open by
  // then.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) open("/dev/null", O_RDWR);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool output_is_closed() {
  pollfd output{STDOUT_FILENO, 0, 0};  // poll() always reports POLLERR and POLLHUP, even if no events are requested
  return poll(&output, 1, 0) == 1 && (output.revents & (POLLERR | POLLHUP)) != 0;
}

int printed(int exit_code) {
  std::cout.flush();
  std::fflush(stdout);
  if (std::cout && std::ferror(stdout) == 0) return exit_code;
  if (output_is_closed()) return kExitBrokenPipe;
  std::cerr << "barehand: standard output cannot be written: is the disk full?" << std::endl;
  return kExitFailure;
}

int failed(const char* command, const Error& error, int exit_code) {
  std::cerr << "barehand " << command << ": " << error.message() << std::endl;
  return exit_code;
}

}  // namespace barehand
