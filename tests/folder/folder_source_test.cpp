#include "drivers/folder/folder_source.h"

#include <gmock/gmock.h>

#include "io/recording/recording_writer.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Folder : public testing::Test {
 protected:
  /// Records seven frames. With `repeat`, frame 4 has the time stamp of frame 3.
  void record(bool repeat = false) {
    auto writer = RecordingWriter::create(path_);
    ASSERT_TRUE(writer);
    RgbdFrame frame;
    frame.camera = {4, 3, 5, 5, 1.5, 1};
    frame.depth.reset(4, 3, 700);
    for (int i = 0; i < 7; ++i) {
      frame.utime = 1'000'000 + 40'000 * (repeat && i == 4 ? 3 : i);
      ASSERT_TRUE(writer->write(frame));
    }
  }
  /// Numbers of the frames played; a skipped frame gives -1.
  std::vector<std::int64_t> play(const FolderRange& range) {
    auto source = FolderSource::open(path_, range);
    if (!source) return {};
    const std::int64_t announced = (*source)->remaining();
    std::vector<std::int64_t> numbers;
    while (true) {
      const SourceEvent event = (*source)->next(std::chrono::milliseconds(0));
      if (std::holds_alternative<EndOfStream>(event)) break;
      const auto* frame = std::get_if<FramePtr>(&event);
      if (frame) {
        EXPECT_EQ((*frame)->utime, 1'000'000 + 40'000 * (*frame)->number);
      }
      if (const auto* skipped = std::get_if<SkippedFrame>(&event)) skipped_.push_back(skipped->error.message());
      numbers.push_back(frame ? (*frame)->number : -1);
    }
    EXPECT_EQ(static_cast<std::int64_t>(numbers.size()), announced);
    EXPECT_EQ((*source)->remaining(), 0);
    return numbers;
  }
  test::TempFolder folder_;
  std::string path_ = folder_ / "recording";
  std::vector<std::string> skipped_;
};

TEST_F(Folder, PlaysForwardsAndBackwardsInStepsWithItsOwnNumbersAndStamps) {
  record();
  EXPECT_THAT(play({}), ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_THAT(play({.start = 2, .step = 2}), ElementsAre(2, 4, 6));
  EXPECT_THAT(play({.start = 1, .step = 3}), ElementsAre(1, 4));
  EXPECT_THAT(play({.start = 3, .step = -1}), ElementsAre(3, 2, 1, 0));
  EXPECT_THAT(play({.start = {}, .step = -4}), ElementsAre(6, 2));
}

TEST_F(Folder, DamagedFileIsSkippedNamedAndPlayGoesOn) {
  record();
  test::write_text(path_ + "/depth/000002.png", "no picture");
  EXPECT_THAT(play({}), ElementsAre(0, 1, -1, 3, 4, 5, 6));
  EXPECT_THAT(skipped_, ElementsAre(HasSubstr("depth/000002.png")));
}

TEST_F(Folder, RepeatedStampIsSkippedInBothDirections) {
  record(true);
  EXPECT_THAT(play({}), ElementsAre(0, 1, 2, 3, -1, 5, 6));
  EXPECT_THAT(play({.start = {}, .step = -1}), ElementsAre(6, 5, -1, 3, 2, 1, 0));
  EXPECT_THAT(skipped_.front(), HasSubstr("frame 4: its time is not later than that of the frame before"));
}

TEST_F(Folder, StartOutsideAndStepZeroAreErrors) {
  record();
  EXPECT_THAT(FolderSource::open(path_, {.start = 7, .step = 1}).error().message(), HasSubstr("frames 0 to 6"));
  EXPECT_THAT(FolderSource::open(path_, {.start = -1, .step = 1}).error().message(), HasSubstr("frame -1"));
  EXPECT_THAT(FolderSource::open(path_, {.start = 0, .step = 0}).error().message(), HasSubstr("--step"));
  EXPECT_FALSE(FolderSource::open(folder_ / "none", {}));
}

TEST_F(Folder, IsAReplayAndSaysItsName) {
  record();
  const auto source = FolderSource::open(path_);
  EXPECT_FALSE((*source)->live());
  EXPECT_EQ((*source)->name(), "folder:" + path_);
}

}  // namespace
}  // namespace barehand
