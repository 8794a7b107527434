#include "io/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "support/ordinary_user.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using test::read_text;
using test::write_text;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class AtomicFiles : public ::testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }
  const test::TempFolder folder_;
  const std::string path_ = folder_ / "out.csv";
};

TEST_F(AtomicFiles, HasItsNameOnlyWhenItIsWhole) {
  auto file = AtomicFile::create(path_, false).value();
  write_text(file.draft(), "half");
  EXPECT_THAT(names(), ElementsAre("out.csv.unfinished"));
  ASSERT_TRUE(file.finish());
  EXPECT_THAT(names(), ElementsAre("out.csv"));
  EXPECT_EQ(read_text(path_), "half");
}

TEST_F(AtomicFiles, OneThatIsNotFinishedLeavesNothing) {
  { const auto file = AtomicFile::create(path_, false).value(); }
  EXPECT_THAT(names(), ElementsAre());
}

TEST_F(AtomicFiles, WhatIsThereIsReplacedOnlyIfAllowed) {
  write_text(path_, "old");
  const auto refused = AtomicFile::create(path_, false);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), AllOf(HasSubstr(path_), HasSubstr("--overwrite")));
  auto file = AtomicFile::create(path_, true).value();
  write_text(file.draft(), "new");
  EXPECT_EQ(read_text(path_), "old") << "before the new one is whole";
  ASSERT_TRUE(file.finish());
  EXPECT_EQ(read_text(path_), "new");
}

TEST_F(AtomicFiles, WhatAppearsInTheMeantimeIsKeptAndSoIsTheDraft) {
  auto file = AtomicFile::create(path_, false).value();
  write_text(file.draft(), "mine");
  write_text(path_, "somebody's");
  const auto finished = file.finish();
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().message(), HasSubstr("out.csv.unfinished"));
  EXPECT_EQ(read_text(path_), "somebody's");
  EXPECT_EQ(read_text(path_ + ".unfinished"), "mine");
}

TEST_F(AtomicFiles, DraftsOfOthersAreLeftAlone) {
  write_text(path_ + ".unfinished", "of a killed program");
  auto second = AtomicFile::create(path_, false).value();
  auto third = AtomicFile::create(path_, false).value();
  EXPECT_THAT(names(), ElementsAre("out.csv.unfinished", "out.csv.unfinished-2", "out.csv.unfinished-3"));
  second.discard();
  third.discard();
  EXPECT_EQ(read_text(path_ + ".unfinished"), "of a killed program");
}

TEST_F(AtomicFiles, ALinkStaysAndItsFileIsReplaced) {
  fs::create_directory(folder_ / "far");
  write_text(folder_ / "far/real.csv", "old");
  fs::create_symlink("far/real.csv", path_);
  auto file = AtomicFile::create(path_, true).value();
  EXPECT_EQ(file.draft(), folder_ / "far/real.csv.unfinished");
  write_text(file.draft(), "new");
  ASSERT_TRUE(file.finish());
  EXPECT_TRUE(fs::is_symlink(path_));
  EXPECT_EQ(read_text(folder_ / "far/real.csv"), "new");
}

TEST_F(AtomicFiles, AnotherNameOfAFileKeepsItsContents) {
  write_text(path_, "old");
  fs::create_hard_link(path_, folder_ / "precious.csv");
  ASSERT_TRUE(write_file_atomically(path_, "new"));
  EXPECT_EQ(read_text(path_), "new");
  EXPECT_EQ(read_text(folder_ / "precious.csv"), "old");
}

TEST_F(AtomicFiles, PermissionsOfAReplacedFileStay) {
  write_text(path_, "old");
  fs::permissions(path_, fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read);
  ASSERT_TRUE(write_file_atomically(path_, "new"));
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read);
}

TEST_F(AtomicFiles, PipesDevicesAndDescriptorsHaveNoDraft) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  write_text(path_, "opened by somebody");
  const int descriptor = open(path_.c_str(), O_RDWR);
  ASSERT_GE(descriptor, 0);
  fs::create_symlink("/dev/null", folder_ / "link");
  for (const std::string& path :
       {std::string("/dev/null"), std::string("/dev/stdout"), folder_ / "pipe", "/dev/fd/" + std::to_string(descriptor),
        "/proc/self/fd/" + std::to_string(descriptor), folder_ / "link"}) {
    auto file = AtomicFile::create(path, false);
    ASSERT_TRUE(file) << file.error().message();
    EXPECT_EQ(file->draft(), path);
    EXPECT_TRUE(file->finish());
  }
  close(descriptor);
  EXPECT_THAT(names(), ElementsAre("link", "out.csv", "pipe"));
}

TEST_F(AtomicFiles, FoldersAndProtectedFilesAreRefused) {
  write_text(path_, "old");
  fs::permissions(path_, fs::perms::owner_read | fs::perms::others_read);
  fs::permissions(folder_.path(), fs::perms::all);
  const test::OrdinaryUser user;
  EXPECT_FALSE(AtomicFile::create(folder_.path(), true));
  EXPECT_FALSE(AtomicFile::create(path_, true));
  EXPECT_FALSE(AtomicFile::create(folder_ / "none/out.csv", true));
  EXPECT_THAT(names(), ElementsAre("out.csv"));
}

TEST_F(AtomicFiles, AFullDiskLeavesTheOldFile) {
  const auto written = write_file_atomically("/dev/full", "text");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message(), HasSubstr("No space left"));
}

TEST_F(AtomicFiles, ADraftTellsItsName) {
  EXPECT_EQ(finished_name("a/take.lcmlog.unfinished"), "a/take.lcmlog");
  EXPECT_EQ(finished_name("take.lcmlog.unfinished-12"), "take.lcmlog");
  for (const char* other : {"take.lcmlog", "take.unfinished.lcmlog", "take.unfinished-", "take.unfinished-2a",
                            ".unfinished", "out/.unfinished", "take.unfinished/a"})
    EXPECT_EQ(finished_name(other), "") << other;
}

TEST_F(AtomicFiles, OnlyAbandonedDraftsAreFinishedByOthers) {
  auto file = AtomicFile::create(path_, false).value();
  EXPECT_TRUE(is_being_written(file.draft()));
  EXPECT_FALSE(finish_abandoned(file.draft(), path_)) << "it is being written";
  file.discard();
  write_text(path_ + ".unfinished", "of a killed program");
  EXPECT_FALSE(is_being_written(path_ + ".unfinished"));
  EXPECT_TRUE(finish_abandoned(path_ + ".unfinished", path_));
  EXPECT_THAT(names(), ElementsAre("out.csv"));
  write_text(path_ + ".unfinished", "of the next one");
  EXPECT_FALSE(finish_abandoned(path_ + ".unfinished", path_)) << "the name is taken";
  EXPECT_EQ(read_text(path_), "of a killed program");
}

}  // namespace
}  // namespace barehand
