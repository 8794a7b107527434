#pragma once

namespace barehand {

/// What the `barehand` command returns to the shell.
enum ExitCode : int {
  kExitOk = 0,       ///< done; also for a daemon that was stopped by SIGTERM
  kExitFailure = 1,  ///< something went wrong while running, or too few frames could be read; what was written until
                     ///< then is kept
  kExitUsage = 2,    ///< wrong arguments, configuration, input or output file; nothing was started
  kExitInterrupted = 130,  ///< Ctrl-C, or SIGTERM before a recording's end; what was written is complete and flushed
  kExitBrokenPipe = 141,   ///< the reader of the output has gone; the shell's code for an end by SIGPIPE
};

}  // namespace barehand
