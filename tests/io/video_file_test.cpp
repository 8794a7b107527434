#include "io/video/video_file.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "read_video.h"
#include "support/resource_limit.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

constexpr double kFps = 30;

/// A red, a green and a blue third, and a white bar that moves with `number`.
Image<Rgb> picture(int number, int width = 96, int height = 64) {
  Image<Rgb> image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const int third = u * 3 / width;
      image.at(u, v) = third == 0 ? Rgb{200, 30, 30} : third == 1 ? Rgb{30, 180, 30} : Rgb{30, 30, 200};
      if (v / 8 == number % 8) image.at(u, v) = {240, 240, 240};
    }
  return image;
}

/// Expects almost the same colour: compression and the halved resolution of colour change it a little.
void expect_near(const Rgb& a, const Rgb& b) {
  EXPECT_NEAR(a.r, b.r, 16);
  EXPECT_NEAR(a.g, b.g, 16);
  EXPECT_NEAR(a.b, b.b, 16);
}

Result<void> write_video(const std::string& path, int pictures, int width = 96, int height = 64) {
  auto video = VideoFile::create(path, kFps);
  if (!video) return tl::unexpected(video.error());
  for (int i = 0; i < pictures; ++i)
    if (auto written = video->write(picture(i, width, height)); !written) return written;
  return video->finish();
}

class VideoFiles : public testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) names.push_back(entry.path().filename());
    return names;
  }
  test::TempFolder folder_;
};

TEST_F(VideoFiles, HoldEveryPicture) {
  const std::pair<const char*, const char*> kCodecs[] = {
      {"a.mp4", "h264"}, {"a.mkv", "h264"}, {"a.webm", "vp9"}, {"a.avi", "mjpeg"}};
  for (const auto& [name, codec] : kCodecs) {
    SCOPED_TRACE(name);
    const auto written = write_video(folder_ / name, 20);
    ASSERT_TRUE(written) << written.error().message();
    const test::ReadVideo video = test::read_video(folder_ / name);
    EXPECT_EQ(video.codec, codec);
    EXPECT_NEAR(video.seconds, 20 / kFps, 0.01);
    ASSERT_EQ(video.pictures.size(), 20);
    for (int i : {0, 7, 19})
      for (const auto& [u, v] : {std::pair{16, 4}, {48, 28}, {80, 60}})
        expect_near(video.pictures[static_cast<std::size_t>(i)].at(u, v), picture(i).at(u, v));
  }
}

TEST_F(VideoFiles, HaveAnyNameAndTheFormatOfItsEnding) {
  for (const char* name : {"take 12:31:35.mp4", "12:31.mkv", "50%.mp4", "frame%03d.mp4", "frame%03d.avi", "%s%n.webm",
                           "gr\u00f6\u00dfe_\u65e5\u672c.mp4", "no\xff utf8.avi", "A.MP4", "b.Mkv", "c.WEBM", "d.AVI",
                           "-i.mp4", "pipe:1.mp4", "two\nlines.mkv", "concat:a|b.avi"}) {
    SCOPED_TRACE(name);
    const auto written = write_video(folder_ / name, 3);
    ASSERT_TRUE(written) << written.error().message();
    EXPECT_EQ(test::read_video(folder_ / name).pictures.size(), 3);
    EXPECT_THAT(names(), testing::ElementsAre(name));
    fs::remove(folder_ / name);
  }
  for (const char* name : {"folder", "a.mp4.d", ".mp4", "mp4", "a.png"}) EXPECT_EQ(video_format(name), nullptr) << name;
}

TEST_F(VideoFiles, NamesMayBeRelativeAndStartWithWhatLooksLikeAProtocol) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  for (const char* name : {"12:31:35.mp4", "http://a.mkv", "file:b.avi"}) {
    const auto written = write_video(name, 3);
    if (std::string(name).find('/') != std::string::npos)
      EXPECT_THAT(written.error().message(), HasSubstr(name)) << "there is no folder http:";
    else
      EXPECT_EQ(test::read_video(folder_ / name).pictures.size(), 3) << name;
  }
  fs::current_path(before);
}

TEST_F(VideoFiles, OfOddSizesRepeatTheLastColumnAndRow) {
  for (const char* name : {"a.mp4", "a.mkv", "a.webm", "a.avi"}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(write_video(folder_ / name, 2, 95, 63));
    const test::ReadVideo video = test::read_video(folder_ / name);
    ASSERT_EQ(video.pictures.size(), 2);
    const Image<Rgb>& shown = video.pictures[1];
    ASSERT_EQ(shown.width(), 96);
    ASSERT_EQ(shown.height(), 64);
    expect_near(shown.at(95, 40), picture(1, 95, 63).at(94, 40));
    expect_near(shown.at(20, 63), picture(1, 95, 63).at(20, 62));
    ASSERT_TRUE(write_video(folder_ / name, 1, 1, 1));
    EXPECT_EQ(test::read_video(folder_ / name).pictures.size(), 1);
  }
}

TEST_F(VideoFiles, AppearWhenTheyAreWhole) {
  ASSERT_TRUE(write_video(folder_ / "a.mp4", 2));
  auto video = VideoFile::create(folder_ / "a.mp4", kFps);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(video->write(picture(i)));
  EXPECT_EQ(test::read_video(folder_ / "a.mp4").pictures.size(), 2) << "still the one that was there";
  ASSERT_TRUE(video->finish());
  EXPECT_EQ(test::read_video(folder_ / "a.mp4").pictures.size(), 5);
  EXPECT_THAT(names(), testing::ElementsAre("a.mp4"));
}

TEST_F(VideoFiles, WithoutAPictureDoNotAppear) {
  ASSERT_TRUE(VideoFile::create(folder_ / "a.mp4", kFps)->finish());
  { const auto video = VideoFile::create(folder_ / "b.avi", kFps); }
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(VideoFiles, OfAMp4TheIndexStandsAtTheFront) {
  ASSERT_TRUE(write_video(folder_ / "a.mp4", 50));
  const std::string bytes = test::read_text(folder_ / "a.mp4");
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
  EXPECT_EQ(bytes.find("moof"), std::string::npos) << "in fragments, which not every player shows";
}

TEST_F(VideoFiles, PlayUpToASecondBeforeTheEndWhenTheProgramIsKilled) {
  for (const char* name : {"a.mp4", "a.mkv", "a.webm", "a.avi"}) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      auto video = VideoFile::create(folder_ / name, kFps);
      for (int i = 0; video && i < 100; ++i) (void)video->write(picture(i));
      raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_FALSE(fs::exists(folder_ / name));
    const std::size_t held = test::read_video(folder_ / (std::string(name) + ".unfinished")).pictures.size();
    EXPECT_GE(held, 100 - kFps) << name;
    EXPECT_LE(held, 100) << name;
  }
}

TEST_F(VideoFiles, AFullDiskIsAnErrorAndLeavesTheDraft) {
  for (const char* name : {"a.mp4", "a.mkv", "a.webm", "a.avi"}) {
    SCOPED_TRACE(name);
    auto video = VideoFile::create(folder_ / name, kFps);
    ASSERT_TRUE(video) << video.error().message();
    const test::FileSizeLimit full(3'000);
    Result<void> written;
    for (int i = 0; i < 200 && written; ++i) written = video->write(picture(i));
    ASSERT_FALSE(written) << "in time, not only at the end";
    for (const auto& result : {written, video->write(picture(0)), video->finish()}) {
      ASSERT_FALSE(result);
      EXPECT_THAT(result.error().message(), AllOf(HasSubstr(folder_ / name + ": cannot be written: File too large"),
                                                  HasSubstr("free space"), HasSubstr(".unfinished")));
    }
    EXPECT_FALSE(fs::exists(folder_ / name));
    EXPECT_TRUE(fs::exists(folder_ / name + ".unfinished"));
  }
}

TEST_F(VideoFiles, OutsideConditionsAreReported) {
  EXPECT_THAT(VideoFile::create(folder_ / "none/a.mp4", kFps).error().message(),
              AllOf(HasSubstr("none/a.mp4"), HasSubstr("cannot be written")));
  fs::create_directory(folder_ / "b.mp4");
  EXPECT_THAT(VideoFile::create(folder_ / "b.mp4", kFps).error().message(), HasSubstr("is a folder"));
  auto video = VideoFile::create(folder_ / "a.avi", kFps);
  ASSERT_TRUE(video->write(picture(0)));
  EXPECT_THAT(video->write(picture(0, 98)).error().message(), HasSubstr("differs in size"));
  EXPECT_TRUE(video->write(picture(1)));
  ASSERT_TRUE(video->finish());
  EXPECT_EQ(test::read_video(folder_ / "a.avi").pictures.size(), 2);
}

TEST_F(VideoFiles, AModuleThatIsMissingOrNoneIsNamed) {
  EXPECT_THAT(load_video_module("/none/libbarehand_video.so").error().message(),
              AllOf(HasSubstr("/none/libbarehand_video.so"), HasSubstr("install the package barehand-video")));
  EXPECT_THAT(load_video_module("libz.so.1").error().message(), HasSubstr("libz.so.1"));
}

}  // namespace
}  // namespace barehand
