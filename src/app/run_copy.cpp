#include "app/run_copy.h"

#include <unistd.h>

#include <csignal>
#include <iostream>

#include "app/copy_frames.h"
#include "app/exit_code.h"
#include "app/interrupt.h"

namespace barehand {
namespace {

FrameWriterOptions writer_options(const CopyRequest& request) {
  FrameWriterOptions options;
  options.encoding.depth = request.depth == "raw"    ? DepthEncoding::raw16
                           : request.depth == "zlib" ? DepthEncoding::zlib
                                                     : DepthEncoding::rvl_zstd;
  options.encoding.colour = request.colour == "none"   ? ColourEncoding::none
                            : request.colour == "raw"  ? ColourEncoding::raw_rgb
                            : request.colour == "jpeg" ? ColourEncoding::jpeg
                                                       : ColourEncoding::png;
  options.encoding.jpeg_quality = request.jpeg_quality;
  options.channel = request.out_channel;
  options.overwrite = request.overwrite;
  return options;
}

int exit_code_of(const CopyResult& result, int signal) {
  if (result.error) return kExitFailure;
  return result.stopped && signal == SIGINT ? kExitInterrupted : kExitOk;
}

}  // namespace

int run_copy(const CopyRequest& request, const std::string& command) {
  const SystemClock clock;
  std::atomic<bool> stop = false;
  const InterruptWatcher interrupt([&stop] { stop = true; });
  const auto refuse = [&](const Error& error) {
    std::cerr << command << ": " << error.message() << "\n";
    return kExitUsage;
  };
  SourceRequest input = request.source;
  input.openni2.fx = input.foreign.fx;
  input.openni2.fy = input.foreign.fy;
  input.openni2.cx = input.foreign.cx;
  input.openni2.cy = input.foreign.cy;
  auto source = open_source(input, clock);
  if (!source) return refuse(source.error());
  if (source->warning) std::cerr << command << ": " << *source->warning << "\n";
  auto writer = open_frame_writer(request.out, writer_options(request));
  if (!writer) return refuse(writer.error());

  CopyOptions options;
  options.frames = request.frames;
  options.seconds = request.seconds;
  options.expected = source->frames;
  options.terminal = isatty(STDERR_FILENO) != 0;
  const CopyResult result = copy_frames(*source->source, **writer, options, stop, clock, std::cerr);
  if (result.error) std::cerr << command << ": " << result.error->message() << "\n";
  std::cerr << command << ": " << result.written << " frames written to " << (*writer)->name();
  if (result.skipped > 0) std::cerr << ", " << result.skipped << " unreadable ones skipped";
  if (result.missing > 0) std::cerr << ", " << result.missing << " never arrived";
  std::cerr << (result.stopped ? ", stopped\n" : "\n");
  return exit_code_of(result, interrupt.signal());
}

}  // namespace barehand
