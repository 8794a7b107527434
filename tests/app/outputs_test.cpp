#include "app/shared/outputs.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>

#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Kind = Output::Kind;
namespace fs = std::filesystem;

/// Creates a recording and a set of two logs in the same folder.
class Outputs : public ::testing::Test {
 protected:
  Outputs() {
    for (const char* folder : {"rec/depth", "rec/rgb", "elsewhere", "set"}) fs::create_directories(folder_ / folder);
    for (const char* file : {"rec/camera.json", "rec/hand.json", "rec/depth/0.png", "rec/rgb/0.jpg", "elsewhere/1.png"})
      test::write_text(folder_ / file, "x");
    test::write_text(folder_ / "rec/depth.txt", "1.0 depth/0.png\n2.0 ../elsewhere/1.png\n");
    test::write_text(folder_ / "rec/rgb.txt", "1.0 rgb/0.jpg\n");
    for (const char* log : {"set/a-000001-20260921T141320Z.lcmlog", "set/lcmlog-2026-09-21.00"})
      test::write_text(folder_ / log, "\xED\xA1\xDA\x01 and so on");
    test::write_text(folder_ / "set/notes.csv", "x");
  }
  /// The error message for writing this output; "" if it is allowed.
  std::string complaint(const SourceFiles& source, const std::string& path, Kind kind = Kind::file,
                        bool overwrite = true) const {
    const auto checked = check_outputs(source, {}, {{"--out", path, kind}}, overwrite);
    return checked ? "" : checked.error().message();
  }
  const test::TempFolder folder_;
};

TEST_F(Outputs, NewFilesMayStandBesideTheFilesOfARecording) {
  const SourceFiles recording = files_of_source("folder:" + (folder_ / "rec"));
  for (const char* name : {"rec/out.csv", "rec/states.lcmlog", "rec/film.mp4", "rec/plots/time.png"})
    EXPECT_EQ(complaint(recording, folder_ / name), "") << name;
  EXPECT_EQ(complaint(recording, folder_ / "rec/overlay", Kind::pictures), "");
}

TEST_F(Outputs, WhatARecordingConsistsOfIsRefused) {
  const SourceFiles recording = files_of_source("folder:" + (folder_ / "rec"));
  for (const char* name : {"rec/camera.json", "rec/depth.txt", "rec/rgb.txt", "rec/truth.csv", "rec/hand.json",
                           "rec/fingertips_2d.csv", "rec/depth/0.png", "rec/rgb/new.csv", "elsewhere/1.png"})
    EXPECT_THAT(complaint(recording, folder_ / name), AllOf(HasSubstr(folder_ / name), HasSubstr("rec"))) << name;
  for (const char* name : {"rec", "rec/", "rec/rgb", "rec/depth/deeper", "elsewhere", "."})
    EXPECT_NE(complaint(recording, folder_ / name, Kind::pictures), "") << name;
  EXPECT_NE(complaint(recording, folder_ / "rec", Kind::recording), "");
}

TEST_F(Outputs, ARecordingWithinTheSourceIsRefused) {
  fs::create_directory_symlink(folder_ / "rec", folder_ / "link");
  for (const char* name : {"rec/sub", "rec/sub/deeper", "link/sub"})
    EXPECT_THAT(complaint(files_of_source("folder:" + (folder_ / "rec")), folder_ / name, Kind::recording),
                HasSubstr("lies in the source"))
        << name;
  EXPECT_NE(complaint(files_of_source("log:" + (folder_ / "set")), folder_ / "set/sub", Kind::recording), "");
  EXPECT_EQ(complaint(files_of_source("folder:" + (folder_ / "rec")), folder_ / "rec2", Kind::recording), "");
}

TEST_F(Outputs, PicturesNeverTakeThePlaceOfARecordingsImages) {
  for (const char* name : {"rec/rgb", "rec/rgb/", "elsewhere/../rec/depth"})
    EXPECT_THAT(complaint({}, folder_ / name, Kind::pictures), HasSubstr("holds images of the recording")) << name;
  EXPECT_EQ(complaint({}, folder_ / "rec/overlay", Kind::pictures), "");
  fs::create_directory_symlink(folder_ / "rec/rgb", folder_ / "link");
  EXPECT_THAT(complaint({}, folder_ / "link", Kind::pictures), HasSubstr("holds images of the recording"));
}

TEST_F(Outputs, AHardLinkToAnImageIsRefused) {
  fs::create_hard_link(folder_ / "rec/rgb/0.jpg", folder_ / "harmless.csv");
  EXPECT_THAT(complaint(files_of_source("folder:" + (folder_ / "rec")), folder_ / "harmless.csv"),
              HasSubstr("rgb/0.jpg of the source"));
}

TEST_F(Outputs, WhereASourceIsALinkItsTargetIsRefused) {
  fs::create_symlink("set/notes.csv", folder_ / "link.lcmlog");
  EXPECT_NE(complaint(files_of_source("log:" + (folder_ / "link.lcmlog")), folder_ / "set/notes.csv"), "");
  fs::create_symlink("../../set/notes.csv", folder_ / "rec/rgb/1.jpg");
  test::write_text(folder_ / "rec/rgb.txt", "1.0 rgb/1.jpg\n");
  EXPECT_NE(complaint(files_of_source("folder:" + (folder_ / "rec")), folder_ / "set/notes.csv"), "");
}

TEST_F(Outputs, ImagesBesideTheListsDoNotCloseTheFolder) {
  test::write_text(folder_ / "rec/flat.png", "x");
  test::write_text(folder_ / "rec/depth.txt", "1.0 flat.png\n");
  const SourceFiles recording = files_of_source("folder:" + (folder_ / "rec"));
  EXPECT_NE(complaint(recording, folder_ / "rec/flat.png"), "");
  EXPECT_EQ(complaint(recording, folder_ / "rec/out.csv"), "");
}

TEST_F(Outputs, AHandMayBeAddedToARecordingWithoutOne) {
  fs::remove(folder_ / "rec/hand.json");
  EXPECT_EQ(complaint(files_of_source("folder:" + (folder_ / "rec")), folder_ / "rec/hand.json"), "");
}

TEST_F(Outputs, LogsOfASetAreToldByTheirContent) {
  const SourceFiles set = files_of_source("log:" + (folder_ / "set"));
  EXPECT_NE(complaint(set, folder_ / "set/lcmlog-2026-09-21.00"), "");
  EXPECT_EQ(complaint(set, folder_ / "set/notes.csv"), "") << "no log";
  EXPECT_EQ(complaint(set, folder_ / "set/result.csv"), "");
  EXPECT_NE(complaint(set, folder_ / "set/new.lcmlog"), "") << "it would be played";
  EXPECT_NE(complaint(set, folder_ / "set/a.lcmlog", Kind::log_set), "");
  EXPECT_NE(complaint(set, folder_ / "set", Kind::recording), "");
}

TEST_F(Outputs, ASetThatASingleLogBelongsToIsRefused) {
  const SourceFiles log = files_of_source("log:" + (folder_ / "set/a-000001-20260921T141320Z.lcmlog"));
  EXPECT_NE(complaint(log, folder_ / "set/a.lcmlog", Kind::log_set), "");
  EXPECT_EQ(complaint(log, folder_ / "set/b.lcmlog", Kind::log_set), "");
  EXPECT_EQ(complaint(log, folder_ / "elsewhere/a.lcmlog", Kind::log_set), "");
}

TEST_F(Outputs, ThePartsThatANameStandsForAreRefused) {
  test::write_text(folder_ / "set/a-000002-20260921T151320Z.lcmlog.unfinished", "\xED\xA1\xDA\x01 and so on");
  for (const char* name : {"set/a-000001-20260921T141320Z.lcmlog", "set/a-000002-20260921T151320Z.lcmlog.unfinished"})
    EXPECT_NE(complaint(files_of_source("log:" + (folder_ / "set/a.lcmlog")), folder_ / name), "") << name;
}

TEST_F(Outputs, NetworksSensorsAndTheSimulatorHaveNoFiles) {
  for (const char* spec : {"lcm", "openni2", "openni2:1d27/0601", "sim:fist"})
    EXPECT_TRUE(files_of_source(spec).files.empty()) << spec;
  EXPECT_EQ(files_of_source("openni2:a.oni").files.front(), "a.oni");
}

TEST_F(Outputs, OtherInputsAndOutputsAreRefused) {
  const std::string a = folder_ / "rec/hand.json", b = folder_ / "b";
  fs::create_symlink(a, b);
  const auto over_input = check_outputs({}, {{"--hand", a}}, {{"--save-hand", b}}, true);
  ASSERT_FALSE(over_input);
  EXPECT_THAT(over_input.error().message(), AllOf(HasSubstr("--save-hand " + b), HasSubstr("--hand " + a)));
  EXPECT_FALSE(check_outputs({}, {}, {{"--result", folder_ / "c"}, {"--states-log", folder_ / "./c"}}, true));
  EXPECT_TRUE(check_outputs({}, {}, {{"--result", "/dev/null"}, {"--states-log", "/dev/null"}}, false));
  EXPECT_TRUE(check_outputs({}, {{"--hand", ""}}, {{"--result", ""}}, false));
}

TEST_F(Outputs, WhatExistsIsReplacedOnlyIfAllowed) {
  EXPECT_THAT(complaint({}, folder_ / "set/notes.csv", Kind::file, false), HasSubstr("--overwrite"));
  EXPECT_EQ(complaint({}, folder_ / "set/notes.csv"), "");
  EXPECT_EQ(complaint({}, folder_ / "set", Kind::pictures, false), "") << "there are no pictures in it";
  test::write_text(folder_ / "set/000012.jpg", "x");
  EXPECT_THAT(complaint({}, folder_ / "set", Kind::pictures, false), HasSubstr("contains images"));
  EXPECT_EQ(complaint({}, folder_ / "set", Kind::pictures), "");
}

TEST_F(Outputs, AMistypedEndingIsRefusedButNoFolder) {
  const auto complaint = [&](const std::string& path, Kind kind = Kind::recording, bool known = false) {
    const auto checked = check_ending({"--out", path, kind}, known, ".lcmlog or .mcap");
    return checked ? "" : checked.error().message();
  };
  EXPECT_EQ(complaint("a/x.mca"),
            "--out a/x.mca: ends in .mca, which is not written here (give a name that ends in .lcmlog or .mcap, or "
            "a/x.mca/ for a folder of this name)");
  EXPECT_THAT(complaint("x.foo", Kind::file), testing::EndsWith("(give a name that ends in .lcmlog or .mcap)"));
  EXPECT_EQ(complaint("x.mcap", Kind::file, true), "");
  fs::create_directory(folder_ / "take.old");
  for (const std::string& folder : {std::string("take"), std::string("../take"), std::string(".take"),
                                    std::string("take.mca/"), std::string("take.2"), std::string("2026.11.28"),
                                    std::string("take.with_both_hands"), std::string(), folder_ / "take.old"})
    EXPECT_EQ(complaint(folder), "") << folder;
  ASSERT_EQ(mkfifo((folder_ / "pipe.foo").c_str(), 0600), 0);
  EXPECT_EQ(complaint(folder_ / "pipe.foo", Kind::file), "") << "its reader knows what it reads";
}

}  // namespace
}  // namespace barehand
