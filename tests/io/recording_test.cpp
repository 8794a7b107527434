#include "io/recording/recording.h"

#include <gmock/gmock.h>

#include "io/recording/image_file.h"
#include "io/recording/recording_writer.h"
#include "support/resource_limit.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

RgbdFrame frame_at(std::int64_t utime, std::uint16_t depth, bool with_colour = true) {
  RgbdFrame frame;
  frame.utime = utime;
  frame.camera = {8, 6, 10.5, 11, 3.5, 2.5};
  frame.depth_unit = 0.0001;
  frame.depth.reset(8, 6, depth);
  frame.depth.at(3, 2) = 0;
  if (with_colour) frame.colour.reset(8, 6, Rgb{200, 100, 50});
  return frame;
}

class RecordingFolder : public testing::Test {
 protected:
  /// Records three frames at intervals of 0.1 s.
  void record(bool with_colour = true) {
    auto writer = RecordingWriter::create(path_, {.fps = 10, .colour_ending = "png"});
    ASSERT_TRUE(writer) << writer.error().message();
    for (int i = 0; i < 3; ++i)
      ASSERT_EQ(writer->write(frame_at(1'700'000'000'000'000 + i * 100'000, 5000 + i, with_colour)), i);
  }
  std::string open_error() {
    const auto recording = open_recording(path_);
    return recording ? "accepted" : recording.error().message();
  }
  void replace(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = test::read_text(path_ + "/" + file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    test::write_text(path_ + "/" + file, text.replace(at, from.size(), to));
  }
  /// Puts `keys` into a camera.json that is otherwise `plain`.
  void add_to_camera(const std::string& plain, const std::string& keys) {
    test::write_text(path_ + "/camera.json", plain);
    replace("camera.json", "\"fx\"", keys + ", \"fx\"");
  }
  Recording open_with(const std::string& plain, const std::string& keys) {
    add_to_camera(plain, keys);
    auto recording = open_recording(path_);
    EXPECT_TRUE(recording) << recording.error().message();
    return *std::move(recording);
  }

  test::TempFolder folder_;
  std::string path_ = folder_ / "recording";
};

TEST_F(RecordingFolder, WhatIsWrittenComesBack) {
  record();
  const auto recording = open_recording(path_);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_EQ(recording->entries.size(), 3u);
  EXPECT_DOUBLE_EQ(recording->fps, 10);
  const auto frame = read_frame(*recording, 2);
  ASSERT_TRUE(frame) << frame.error().message();
  const RgbdFrame written = frame_at(1'700'000'000'200'000, 5002);
  EXPECT_EQ((*frame)->utime, written.utime);
  EXPECT_EQ((*frame)->number, 2);
  EXPECT_EQ((*frame)->camera, written.camera);
  EXPECT_DOUBLE_EQ((*frame)->depth_unit, written.depth_unit);
  EXPECT_EQ((*frame)->depth.at(0, 0), 5002);
  EXPECT_EQ((*frame)->depth.at(3, 2), 0);
  EXPECT_EQ((*frame)->colour.at(7, 5), (Rgb{200, 100, 50}));
}

TEST_F(RecordingFolder, DepthAloneIsEnough) {
  record(false);
  EXPECT_FALSE(fs::exists(path_ + "/rgb.txt"));
  const auto recording = open_recording(path_);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_TRUE((*read_frame(*recording, 0))->colour.empty());
}

TEST_F(RecordingFolder, ColourIsTheNearestInTimeWithinOneFrame) {
  record();
  test::write_text(path_ + "/rgb.txt",
                   "1700000000.140000 rgb/late.png\n# a comment\n1700000000.010000 rgb/first.png\n"
                   "1700000000.090000 rgb/second.png\n");
  const auto recording = open_recording(path_);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_EQ(recording->entries[0].colour_file, path_ + "/rgb/first.png");
  EXPECT_EQ(recording->entries[1].colour_file, path_ + "/rgb/second.png");
  EXPECT_EQ(recording->entries[2].colour_file, path_ + "/rgb/late.png");
  test::write_text(path_ + "/rgb.txt", "1700000000.000000 rgb/first.png\n");
  EXPECT_EQ(open_recording(path_)->entries[2].colour_file, "") << "colour two frames old shows another pose";
}

TEST_F(RecordingFolder, NothingIsOverwritten) {
  record();
  const auto again = RecordingWriter::create(path_);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message(), HasSubstr("already holds a recording"));
}

TEST_F(RecordingFolder, PartsOfAnotherRecordingAreNotOverwritten) {
  for (const char* part : {"camera.json", "rgb.txt", "depth.txt.unfinished", "rgb/000000.png", "depth/000000.png"}) {
    fs::create_directories((path_ + "/" + part).substr(0, (path_ + "/" + part).rfind('/')));
    test::write_text(path_ + "/" + part, "somebody's");
    EXPECT_FALSE(RecordingWriter::create(path_)) << part;
    EXPECT_EQ(test::read_text(path_ + "/" + part), "somebody's");
    fs::remove_all(path_);
  }
}

TEST_F(RecordingFolder, IsNoRecordingBeforeItIsFinished) {
  auto writer = RecordingWriter::create(path_);
  ASSERT_TRUE(writer->write(frame_at(0, 1)));
  EXPECT_THAT(open_error(), AllOf(HasSubstr("depth.txt: is missing"), HasSubstr("depth.txt.unfinished")));
  ASSERT_TRUE(writer->finish());
  EXPECT_EQ(open_error(), "accepted");
  EXPECT_FALSE(writer->write(frame_at(1, 1))) << "after the end";
}

TEST_F(RecordingFolder, WithoutAFrameNothingIsLeft) {
  ASSERT_TRUE(RecordingWriter::create(path_)->finish());
  EXPECT_FALSE(fs::exists(path_));
  fs::create_directory(path_);
  test::write_text(path_ + "/notes.txt", "of the user");
  ASSERT_TRUE(RecordingWriter::create(path_)->finish());
  EXPECT_TRUE(fs::exists(path_ + "/notes.txt"));
  EXPECT_FALSE(fs::exists(path_ + "/depth"));
}

TEST_F(RecordingFolder, CameraMayNotChange) {
  auto writer = RecordingWriter::create(path_);
  ASSERT_TRUE(writer->write(frame_at(0, 1)));
  RgbdFrame other = frame_at(1, 1);
  other.camera.fx = 12;
  EXPECT_THAT(writer->write(other).error().message(), HasSubstr("camera changed at frame 1"));
}

TEST_F(RecordingFolder, ARecorderThatWasStartedAgainIsWrittenAndReadWithItsOwnColour) {
  auto writer = RecordingWriter::create(path_);
  for (int part = 0; part < 2; ++part) {
    for (int i = 0; i < 3; ++i) {
      RgbdFrame frame = frame_at(1'000'000 * i - 500'000, 1);  // in both cases the first time is negative
      frame.colour.at(0, 0) = {static_cast<std::uint8_t>(part), static_cast<std::uint8_t>(i), 0};
      ASSERT_TRUE(writer->write(frame));
    }
  }
  ASSERT_TRUE(writer->finish());
  const auto recording = open_recording(path_);
  ASSERT_TRUE(recording) << recording.error().message();
  ASSERT_EQ(recording->entries.size(), 6u);
  for (int n = 0; n < 6; ++n) {
    EXPECT_EQ(recording->entries[n].utime, 1'000'000 * (n % 3) - 500'000);
    EXPECT_EQ((*read_frame(*recording, n))->colour.at(0, 0),
              (Rgb{static_cast<std::uint8_t>(n / 3), static_cast<std::uint8_t>(n % 3), 0}));
  }
}

TEST_F(RecordingFolder, ColourOfOnePartIsNotUsedForAnother) {
  auto writer = RecordingWriter::create(path_);
  for (int n = 0; n < 6; ++n) ASSERT_TRUE(writer->write(frame_at(1'000'000 * (n % 3), 1, n < 3)));
  ASSERT_TRUE(writer->finish());
  const auto recording = open_recording(path_);
  for (int n = 0; n < 6; ++n) EXPECT_EQ(recording->entries[n].colour_file.empty(), n >= 3) << n;
}

TEST_F(RecordingFolder, FullDiskIsReported) {
  auto writer = RecordingWriter::create(path_);
  fs::create_symlink("/dev/full", path_ + "/depth/000000.png");
  const auto written = writer->write(frame_at(0, 1, false));
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message(), AllOf(HasSubstr("depth/000000.png"), HasSubstr("free space")));
}

TEST_F(RecordingFolder, GoesOnWithTheNextFrameWhenThereIsRoomAgain) {
  RgbdFrame frame = frame_at(0, 1, false);
  auto writer = RecordingWriter::create(path_);
  for (; frame.utime < 20; ++frame.utime) ASSERT_TRUE(writer->write(frame));
  const std::string list = path_ + "/depth.txt.unfinished";
  const auto size = fs::file_size(list);
  {
    const test::FileSizeLimit full(size + 5);  // the image fits, but half of its line
    EXPECT_FALSE(writer->write(frame));
    EXPECT_EQ(fs::file_size(list), size);
  }
  ++frame.utime;
  ASSERT_TRUE(writer->write(frame));
  ASSERT_TRUE(writer->finish());
  const auto recording = open_recording(path_);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_EQ(recording->entries.size(), 21u);
  EXPECT_EQ(recording->entries.back().utime, 21);
}

TEST_F(RecordingFolder, StartsWhenThereIsRoomForTheFirstImage) {
  RgbdFrame frame = frame_at(0, 1, false);
  frame.camera.width = frame.camera.height = 64;
  frame.depth.reset(64, 64);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) frame.depth[i] = static_cast<std::uint16_t>(i * i * 40503);
  auto writer = RecordingWriter::create(path_);
  {
    const test::FileSizeLimit full(500);  // camera.json and the head of depth.txt fit
    for (int i = 0; i < 2; ++i) EXPECT_FALSE(writer->write(frame));
  }
  EXPECT_EQ(writer->write(frame), 0);
  ASSERT_TRUE(writer->finish());
  EXPECT_EQ(open_recording(path_)->entries.size(), 1u);
}

TEST_F(RecordingFolder, MissingIntrinsicsAreNamed) {
  record();
  replace("camera.json", "\"fx\"", "\"focal\"");
  EXPECT_THAT(open_error(), AllOf(HasSubstr("camera.json"), HasSubstr("\"fx\" is missing")));
  fs::remove(path_ + "/camera.json");
  EXPECT_THAT(open_error(), AllOf(HasSubstr("camera.json"), HasSubstr("intrinsics")));
}

TEST_F(RecordingFolder, ExtraCameraKeysAreAllowed) {
  record();
  replace("camera.json", "\"fx\"", "\"maker\": \"someone\", \"fx\"");
  EXPECT_EQ(open_error(), "accepted");
}

TEST_F(RecordingFolder, EmptyFolderIsAnError) {
  fs::create_directories(path_);
  EXPECT_THAT(open_error(), HasSubstr("camera.json: is missing"));
  record();
  test::write_text(path_ + "/depth.txt", "# timestamp filename\n\n");
  EXPECT_THAT(open_error(), AllOf(HasSubstr("depth.txt"), HasSubstr("no frames")));
  fs::remove(path_ + "/depth.txt");
  EXPECT_THAT(open_error(), HasSubstr("depth.txt: cannot be read"));
  path_ += "/nothing";
  EXPECT_THAT(open_error(), HasSubstr("is not a folder"));
}

TEST_F(RecordingFolder, WhatCannotBeLookedAtIsAnErrorToo) {
  record();
  fs::remove(path_ + "/rgb.txt");
  fs::create_symlink("rgb.txt", path_ + "/rgb.txt");  // a link to itself
  EXPECT_THAT(open_recording(path_)->warnings, ElementsAre(HasSubstr("rgb.txt: cannot be read")));
  fs::remove(path_ + "/camera.json");
  fs::create_symlink("camera.json", path_ + "/camera.json");
  EXPECT_THAT(open_error(), HasSubstr("camera.json: cannot be read"));
  path_ = folder_ / std::string(300, 'x');
  EXPECT_THAT(open_error(), AllOf(HasSubstr("is not a folder"), HasSubstr("name too long")));
  EXPECT_FALSE(RecordingWriter::create(path_));
}

TEST_F(RecordingFolder, FramesOutOfOrderAreNotUsedAndALargeStepBackIsANewStart) {
  record();
  replace("depth.txt", "1700000000.100000", "1699999999.900000");
  EXPECT_THAT(open_recording(path_)->entries[1].fault, HasSubstr("not later than that of the frame before"));
  EXPECT_EQ(open_recording(path_)->entries[2].fault, "");
  replace("depth.txt", "1699999999.900000", "17.000000");
  const auto recording = open_recording(path_);
  EXPECT_EQ(recording->entries[1].fault, "");
  EXPECT_THAT(recording->warnings,
              ElementsAre(AllOf(HasSubstr("depth.txt"), HasSubstr("frame 1"), HasSubstr("new start"))));
}

TEST_F(RecordingFolder, StampsBeforeZeroAndWithExponentsAreTimes) {
  record(false);
  test::write_text(path_ + "/depth.txt",
                   "-0.05 depth/000000.png\n-1.7e-2 depth/000001.png\n1.6000000000000000e-02 depth/000002.png\n");
  const auto recording = open_recording(path_);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_EQ(recording->entries[0].utime, -50'000);
  EXPECT_EQ(recording->entries[1].utime, -17'000);
  EXPECT_EQ(recording->entries[2].utime, 16'000);
  EXPECT_THAT(recording->warnings, IsEmpty());
}

TEST_F(RecordingFolder, StampsInOtherUnitsAreNamedAndThoseThatCannotBeTimesStopTheStart) {
  record(false);
  const auto list = [&](const char* first, const char* second, const char* third) {
    std::string text;
    for (const char* stamp : {first, second, third}) text += std::string(stamp) + " depth/000000.png\n";
    test::write_text(path_ + "/depth.txt", text);
  };
  list("1000", "1033.3", "1066.7");
  EXPECT_THAT(open_recording(path_)->warnings, ElementsAre(HasSubstr("milliseconds: divide them by 1e3")));
  list("1", "2", "3");
  EXPECT_THAT(open_recording(path_)->warnings, ElementsAre(HasSubstr("frame numbers")));
  list("1700000000000", "1700000000033", "1700000000067");
  EXPECT_THAT(open_error(), AllOf(HasSubstr("line 1"), HasSubstr("milliseconds since the epoch")));
  list("1700000000000000000", "1700000000033000000", "1700000000067000000");
  EXPECT_THAT(open_error(), AllOf(HasSubstr("line 1"), HasSubstr("nanoseconds since the epoch")));
  list("1", "inf", "2");
  EXPECT_THAT(open_error(), HasSubstr("line 2 is \"inf"));
}

TEST_F(RecordingFolder, SenselessLineIsNamed) {
  record();
  replace("depth.txt", "1700000000.100000", "noon");
  EXPECT_THAT(open_error(), HasSubstr("line 3 is \"noon depth/000001.png\""));
}

TEST_F(RecordingFolder, DepthOfAnotherSizeThanTheCameraStopsTheStart) {
  record();
  replace("camera.json", "\"width\": 8", "\"width\": 640");
  EXPECT_THAT(open_error(), AllOf(HasSubstr("depth/000000.png"), HasSubstr("is 8x6, camera.json says 640x6")));
}

TEST_F(RecordingFolder, BadImagesAreNamed) {
  record();
  const auto recording = open_recording(path_);
  const auto error = [&](std::int64_t number) {
    const auto frame = read_frame(*recording, number);
    return frame ? "accepted" : frame.error().message();
  };
  fs::resize_file(path_ + "/depth/000000.png", 60);
  EXPECT_THAT(error(0), AllOf(HasSubstr("depth/000000.png"), HasSubstr("damaged")));
  ASSERT_TRUE(write_depth_png(path_ + "/depth/000001.png", Image<std::uint16_t>(4, 6)));
  EXPECT_THAT(error(1), AllOf(HasSubstr("depth/000001.png"), HasSubstr("is 4x6")));
  ASSERT_TRUE(write_colour(path_ + "/depth/000001.png", Image<Rgb>(8, 6)));
  EXPECT_THAT(error(1), HasSubstr("not a 16-bit image"));
}

TEST_F(RecordingFolder, ColourThatIsMissingDamagedOrOfAnotherSizeCostsNoDepth) {
  record();
  const auto recording = open_recording(path_);
  const auto expect_depth_alone = [&](const char* why) {
    const auto frame = read_frame(*recording, 2);
    ASSERT_TRUE(frame) << frame.error().message();
    EXPECT_EQ((*frame)->depth.at(0, 0), 5002);
    EXPECT_TRUE((*frame)->colour.empty());
    EXPECT_THAT((*frame)->colour_fault, AllOf(HasSubstr("rgb/000002.png"), HasSubstr(why)));
  };
  const std::string path = path_ + "/rgb/000002.png";
  ASSERT_TRUE(write_colour(path, Image<Rgb>(16, 12)));
  expect_depth_alone("is 16x12, depth is 8x6");
  ASSERT_TRUE(write_depth_png(path, Image<std::uint16_t>(4, 6)));
  expect_depth_alone("is 4x6");
  test::write_text(path, "");
  expect_depth_alone("rgb");
  test::write_text(path, "<html>404</html>");
  expect_depth_alone("neither a PNG nor a JPEG");
  fs::remove(path);
  expect_depth_alone("cannot be read");
  fs::create_directory(path);
  expect_depth_alone("is a folder");
}

TEST_F(RecordingFolder, AListOfColourThatMakesNoSenseCostsNoDepth) {
  record();
  for (const char* text : {"", "# nothing\n", "noon rgb/000000.png\n", "1700000000.0\n", "1.7e18 rgb/000000.png\n"}) {
    test::write_text(path_ + "/rgb.txt", text);
    const auto recording = open_recording(path_);
    ASSERT_TRUE(recording) << text;
    EXPECT_THAT(recording->warnings, ElementsAre(AllOf(HasSubstr("rgb.txt"), HasSubstr("without colour")))) << text;
    EXPECT_TRUE((*read_frame(*recording, 0))->colour.empty());
  }
}

TEST_F(RecordingFolder, FramesBetweenTheColourImagesSayThatTheyHaveNone) {
  record();
  test::write_text(path_ + "/rgb.txt", "1700000000.000000 rgb/000000.png\n");
  const auto recording = open_recording(path_);
  EXPECT_EQ((*read_frame(*recording, 0))->colour_fault, "");
  EXPECT_THAT((*read_frame(*recording, 2))->colour_fault, HasSubstr("rgb.txt lists none within 0.100 s"));
}

TEST_F(RecordingFolder, ColourWhoseStampsAreInAnotherUnitIsSaid) {
  record();
  const auto warnings_with = [&](const char* list) {
    test::write_text(path_ + "/rgb.txt", list);
    return open_recording(path_)->warnings;
  };
  test::write_text(path_ + "/depth.txt", "0.1 depth/000000.png\n0.2 depth/000001.png\n0.3 depth/000002.png\n");
  EXPECT_THAT(warnings_with("300 rgb/000002.png\n200 rgb/000001.png\n100 rgb/000000.png\n"),
              ElementsAre(AllOf(HasSubstr("rgb.txt: stamps are in seconds"), HasSubstr("100 s apart"),
                                HasSubstr("milliseconds: divide them by 1e3"), HasSubstr("without colour"))));
  EXPECT_THAT(warnings_with("0.1 rgb/000000.png\n0.2 rgb/000001.png\n0.3 rgb/000002.png\n"), IsEmpty());
  EXPECT_THAT(warnings_with("7 rgb/000000.png\n7.1 rgb/000001.png\n7.2 rgb/000002.png\n"), IsEmpty())
      << "another clock, but seconds";
  test::write_text(path_ + "/depth.txt", "0 depth/000000.png\n100 depth/000001.png\n200 depth/000002.png\n");
  EXPECT_THAT(warnings_with("0 rgb/000000.png\n100 rgb/000001.png\n200 rgb/000002.png\n"),
              ElementsAre(HasSubstr("depth.txt")))
      << "said once where both lists have the same unit";
}

TEST_F(RecordingFolder, LensDistortionIsTakenOutOrSaid) {
  record();
  const std::string plain = test::read_text(path_ + "/camera.json");
  const auto undistorted = [&](const std::string& keys) {
    const Recording recording = open_with(plain, keys);
    EXPECT_THAT(recording.warnings, ElementsAre(AllOf(HasSubstr("undistorted"), HasSubstr("rectified")))) << keys;
    return recording.undistortion != nullptr;
  };
  EXPECT_TRUE(undistorted(R"("distortion_model": "plumb_bob", "D": [-2.5, 0, 0, 0, 0])")) << "ROS";
  EXPECT_TRUE(undistorted(R"("distortion_coefficients": {"rows": 1, "cols": 5, "data": [-2.5, 0, 0, 0, 0]})"))
      << "OpenCV";
  EXPECT_TRUE(undistorted(R"("k1": -2.5, "k2": 0.1)"));
  EXPECT_TRUE(undistorted(R"("distortion": [-2.5, 0, 0, 0])"));
  EXPECT_TRUE(undistorted(R"("model": "rational", "dist_coeffs": [-2.5, 0, 0, 0, 0, 0.1, 0, 0])")) << "k4a";
  EXPECT_TRUE(undistorted(R"("model": "Intel RealSense D435", "coeffs": [-2.5, 0, 0, 0, 0])"));
  EXPECT_TRUE(undistorted(R"("intrinsics": {"model": "brown_conrady", "coeffs": [-2.5, 0, 0, 0, 0]})")) << "nested";

  const auto refused = [&](const std::string& keys, const char* why) {
    const Recording recording = open_with(plain, keys);
    EXPECT_THAT(recording.warnings, ElementsAre(HasSubstr(why))) << keys;
    return recording.undistortion == nullptr;
  };
  EXPECT_TRUE(refused(R"("model": "inverse_brown_conrady", "coeffs": [-2.5, 0, 0, 0, 0])", "inverse_brown_conrady"));
  EXPECT_TRUE(refused(R"("distortion_model": "equidistant", "D": [0.1, 0, 0, 0])", "equidistant"));
  EXPECT_TRUE(refused(R"("distortion_model": "my own", "k1": 0.1)", "my own"));
  EXPECT_TRUE(refused(R"("D": [0.1, 0, 0, 0, 0, 0, 0, 0, 0.2, 0, 0, 0])", "beyond k6")) << "thin prism";
  EXPECT_TRUE(refused(R"("D": [-4000, 0, 0, 0, 0])", "implausible"));

  for (const char* none :
       {R"("D": [0, 0, 0, 0, 0])", R"("D": [])", R"("k1": 0.0)", R"("distortion_model": "plumb_bob")",
        R"("model": "none", "coeffs": [0.1, 0, 0, 0, 0])", R"("D": [1e-6, 0, 0, 0, 0])",
        R"("D": [-2.5, 0, 0, 0, 0], "rectified": true)", R"("distortion": null)"}) {
    const Recording recording = open_with(plain, none);
    EXPECT_THAT(recording.warnings, IsEmpty()) << none;
    EXPECT_FALSE(recording.undistortion) << none;
  }
}

TEST_F(RecordingFolder, DistortionThatIsSpelledOtherwiseIsSaidWithItsPlace) {
  record();
  const std::string plain = test::read_text(path_ + "/camera.json");
  const auto warnings_with = [&](const std::string& keys) { return open_with(plain, keys).warnings; };
  const auto said = [&](const std::string& keys, const std::string& place) {
    EXPECT_THAT(warnings_with(keys),
                ElementsAre(AllOf(HasSubstr("camera.json: " + place), HasSubstr("not used"), HasSubstr("k1, k2"))))
        << keys;
  };
  said(R"("distortion": {"coefficients": [-2.5, 0, 0, 0]})", "\"distortion.coefficients\"");
  said(R"("depth_camera": {"D": [-2.5, 0, 0, 0, 0]})", "\"depth_camera.D\"");
  said(R"("cameras": [{}, {"lens": {"k1": "-2.5", "K2": 0.1, "p1": 0}}])", "\"cameras.1.lens.K2\" and 1 more");
  said(R"("dist_coeffs": "-2.5 0 0 0 0")", "\"dist_coeffs\"");
  said(R"("D": [0, 0, 0, 0], "lensDistortion": {"radial": [-2.5]})", "\"lensDistortion\"");
  EXPECT_THAT(warnings_with(R"("colour": {"D": [0, 0], "distortion": "brown", "d1": 2, "K": [525, 1]})"), IsEmpty());
  EXPECT_THAT(warnings_with(R"("depth_camera": {"D": [-2.5, 0, 0, 0, 0]}, "rectified": true)"), IsEmpty());
}

TEST_F(RecordingFolder, ACoefficientThatIsNoNumberIsRefused) {
  record();
  const std::string plain = test::read_text(path_ + "/camera.json");
  const auto refusal = [&](const std::string& keys) {
    add_to_camera(plain, keys);
    return open_error();
  };
  EXPECT_THAT(refusal(R"("k1": "-0.25")"), AllOf(HasSubstr("camera.json: \"k1\" is \"-0.25\""), HasSubstr("a number")));
  EXPECT_THAT(refusal(R"("D": [-0.25, "0.1", 0, 0])"), HasSubstr("\"D\" is \"0.1\", not a number"));
  EXPECT_THAT(refusal(R"("D": [[-0.25, 0.1, 0, 0]])"), HasSubstr("\"D\" is an array, not a number"));
  EXPECT_THAT(refusal(R"("intrinsics": {"k2": "none"})"), HasSubstr("camera.json: intrinsics: \"k2\""));
  EXPECT_THAT(refusal(R"("distortion_coefficients": {"data": [null]})"),
              HasSubstr("distortion_coefficients: \"data\""));
}

TEST_F(RecordingFolder, ListsThatAreNestedDeeplyAreRefusedLikeOthers) {
  record();
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  replace("camera.json", "\"fx\"", "\"D\": [" + deep + "], \"fx\"");
  EXPECT_THAT(open_error(), HasSubstr("\"D\" is an array, not a number"));
}

TEST_F(RecordingFolder, DepthAndColourAreUndistortedAlike) {
  record();
  Image<std::uint16_t> depth(8, 6, 5000);
  Image<Rgb> colour(8, 6, Rgb{200, 100, 50});
  depth.at(1, 1) = 7000;
  colour.at(1, 1) = {1, 2, 3};
  ASSERT_TRUE(write_depth_png(path_ + "/depth/000000.png", depth));
  ASSERT_TRUE(write_colour(path_ + "/rgb/000000.png", colour));
  replace("camera.json", "\"fx\"", "\"k1\": -1.8, \"fx\"");
  const auto frame = read_frame(*open_recording(path_), 0);
  ASSERT_TRUE(frame);
  EXPECT_EQ((*frame)->depth.at(0, 0), 7000) << "a barrel draws the corners inwards";
  EXPECT_EQ((*frame)->colour.at(0, 0), (Rgb{1, 2, 3}));
  EXPECT_EQ((*frame)->depth.at(4, 3), 5000);
}

TEST_F(RecordingFolder, ImagesThatAreTooLargeOrOfAnotherKindDoNotReachTheDecoder) {
  const std::string path = folder_ / "depth.png";
  ASSERT_TRUE(write_depth_png(path, Image<std::uint16_t>(8, 6)));
  std::string bytes = test::read_text(path);
  const std::size_t width_at = 16, height_at = 20;  // 32 bits, big endian
  bytes[width_at + 2] = bytes[height_at + 2] = '\x7F';
  test::write_text(path, bytes);
  for (const auto& error : {read_depth_png(path).error(), read_colour(path).error()})
    EXPECT_THAT(error.message(), AllOf(HasSubstr(path), HasSubstr("implausible size")));
  test::write_text(path, "P5 2 2 65535\n12345678");  // a PGM that OpenCV would read
  EXPECT_THAT(read_depth_png(path).error().message(), HasSubstr("neither a PNG nor a JPEG"));
  record();
  replace("camera.json", "\"width\": 8", "\"width\": 16384");
  replace("camera.json", "\"height\": 6", "\"height\": 16384");
  EXPECT_THAT(open_error(), AllOf(HasSubstr("camera.json"), HasSubstr("too large")));
}

TEST_F(RecordingFolder, TruncatedJpegIsDamagedNotGrey) {
  const std::string path = folder_ / "colour.jpg";
  Image<Rgb> colour(64, 64);
  for (std::size_t i = 0; i < colour.size(); ++i) colour[i].r = static_cast<std::uint8_t>(i * 37);
  ASSERT_TRUE(write_colour(path, colour));
  ASSERT_TRUE(read_colour(path));
  fs::resize_file(path, fs::file_size(path) * 3 / 4);
  EXPECT_FALSE(read_colour(path));
}

}  // namespace
}  // namespace barehand
