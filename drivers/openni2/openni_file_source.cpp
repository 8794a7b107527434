// Plays an .oni recording as a source of frames.
#include "drivers/openni2/openni_file_source.h"

#include "drivers/openni2/openni_file_player.h"

namespace barehand {

Result<std::unique_ptr<OpenNiFileSource>> OpenNiFileSource::open(const std::string& path, const OpenNiParams& params,
                                                                 std::int64_t start, std::int64_t step) {
  if (step < 1) return fail("an .oni file plays forward only", path, "convert it to a log or folder to play backwards");
  auto player = OpenNiFilePlayer::open(path, params);
  if (!player) return tl::unexpected(player.error());
  if (start < 0 || start >= (*player)->frames())
    return fail("there is no frame " + std::to_string(start), path,
                "give 0 to " + std::to_string((*player)->frames() - 1));
  return std::unique_ptr<OpenNiFileSource>(new OpenNiFileSource(path, std::move(*player), start, step));
}

OpenNiFileSource::OpenNiFileSource(std::string path, std::unique_ptr<OpenNiFilePlayer> player, std::int64_t start,
                                   std::int64_t step)
    : path_(std::move(path)), player_(std::move(player)), step_(step), wanted_(start) {}

OpenNiFileSource::~OpenNiFileSource() = default;

SourceEvent OpenNiFileSource::next(std::chrono::milliseconds) {
  // Read and drop the frames that are not requested, since OpenNI2 crashes when it seeks.
  while (player_->position() < wanted_) {
    SourceEvent passed = player_->next();
    if (std::holds_alternative<EndOfStream>(passed) || std::holds_alternative<SourceFailed>(passed)) return passed;
  }
  wanted_ = player_->position() + step_;
  return player_->next();
}

std::int64_t OpenNiFileSource::remaining() const {
  const std::int64_t left = player_->frames() - wanted_;
  return left <= 0 ? 0 : (left + step_ - 1) / step_;
}

double OpenNiFileSource::fps() const { return player_->sensor().depth_mode().getFps(); }

std::optional<std::string> OpenNiFileSource::warning() const {
  std::string text;
  for (const std::string& shortfall : player_->sensor().shortfalls())
    text += (text.empty() ? "it " : "; it ") + shortfall;
  if (text.empty()) return std::nullopt;
  return path_ + ": " + text;
}

}  // namespace barehand
