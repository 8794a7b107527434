// Plays a recording folder as a source of frames.
#include "drivers/folder/folder_source.h"

namespace barehand {

Result<std::unique_ptr<FolderSource>> FolderSource::open(const std::string& directory, const FolderRange& range) {
  auto recording = open_recording(directory);
  if (!recording) return tl::unexpected(recording.error());
  const auto count = static_cast<std::int64_t>(recording->entries.size());
  if (range.step == 0)
    return fail("a step of 0 would repeat one frame without end", "--step", "choose 1, 2 ... or -1, -2 ...");
  const ReplayPosition position(range.start, range.step, count);
  if (position.at_end())
    return fail("frame " + std::to_string(position.next()) + " is not in the recording", directory,
                "it holds frames 0 to " + std::to_string(count - 1));
  return std::unique_ptr<FolderSource>(new FolderSource(std::move(*recording), position));
}

SourceEvent FolderSource::next(std::chrono::milliseconds) {
  const auto number = position_.take();
  if (!number) return EndOfStream{};
  const RecordingEntry& entry = recording_.entries[*number];
  if (!entry.fault.empty())
    return SkippedFrame{{"frame " + std::to_string(*number) + ": " + entry.fault, entry.depth_file, ""}};
  auto frame = read_frame(recording_, *number);
  if (!frame) return SkippedFrame{frame.error()};
  return *frame;
}

}  // namespace barehand
