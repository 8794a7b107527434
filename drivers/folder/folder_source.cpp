#include "drivers/folder/folder_source.h"

namespace barehand {

Result<std::unique_ptr<FolderSource>> FolderSource::open(const std::string& directory, const FolderRange& range) {
  auto recording = open_recording(directory);
  if (!recording) return tl::unexpected(recording.error());
  const auto count = static_cast<std::int64_t>(recording->entries.size());
  if (range.step == 0)
    return fail("a step of 0 would repeat one frame without end", "--step", "choose 1, 2 ... or -1, -2 ...");
  const std::int64_t start = range.start.value_or(range.step > 0 ? 0 : count - 1);
  if (start < 0 || start >= count)
    return fail("frame " + std::to_string(start) + " is not in the recording", directory,
                "it holds frames 0 to " + std::to_string(count - 1));
  return std::unique_ptr<FolderSource>(new FolderSource(std::move(*recording), start, range.step));
}

SourceEvent FolderSource::next(std::chrono::milliseconds) {
  if (next_ < 0 || next_ >= static_cast<std::int64_t>(recording_.entries.size())) return EndOfStream{};
  const std::int64_t number = next_;
  next_ += step_;
  const RecordingEntry& entry = recording_.entries[number];
  if (!entry.fault.empty())
    return SkippedFrame{{"frame " + std::to_string(number) + ": " + entry.fault, entry.depth_file, ""}};
  auto frame = read_frame(recording_, number);
  if (!frame) return SkippedFrame{frame.error()};
  return *frame;
}

std::int64_t FolderSource::remaining() const {
  const auto count = static_cast<std::int64_t>(recording_.entries.size());
  if (next_ < 0 || next_ >= count) return 0;
  return step_ > 0 ? (count - next_ + step_ - 1) / step_ : next_ / -step_ + 1;
}

}  // namespace barehand
