#include "io/place.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "support/temp_folder.h"

namespace barehand {
namespace {

namespace fs = std::filesystem;

class Places : public ::testing::Test {
 protected:
  Places() {
    fs::create_directories(folder_ / "rec/rgb");
    test::write_text(file_, "x");
  }
  const test::TempFolder folder_;
  const std::string rec_ = folder_ / "rec", file_ = folder_ / "rec/rgb/a.png";
};

TEST_F(Places, AFileIsTheSameUnderAllItsNames) {
  fs::create_hard_link(file_, folder_ / "hard.png");
  fs::create_symlink(file_, folder_ / "soft.png");
  fs::create_directory_symlink(folder_ / "rec/rgb", folder_ / "pictures");
  for (const std::string& name : {folder_ / "hard.png", folder_ / "soft.png", folder_ / "pictures/a.png",
                                  folder_ / "rec/./rgb//a.png", folder_ / "rec/rgb/../rgb/a.png"})
    EXPECT_EQ(Place(name), Place(file_)) << name;
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  EXPECT_EQ(Place("rec/rgb/a.png"), Place(file_));
  EXPECT_EQ(Place("./rec/rgb/none.png"), Place(folder_ / "rec/rgb/none.png"));
  fs::current_path(before);
  EXPECT_FALSE(Place(rec_) == Place(file_));
}

TEST_F(Places, WhatIsNotThereIsANameInAFolder) {
  fs::create_directory_symlink(rec_, folder_ / "link");
  fs::create_symlink("rec/new.csv", folder_ / "dangling");
  EXPECT_FALSE(Place(folder_ / "rec/new.csv").exists());
  EXPECT_EQ(Place(folder_ / "link/new.csv"), Place(folder_ / "rec/new.csv"));
  EXPECT_EQ(Place(folder_ / "dangling"), Place(folder_ / "rec/new.csv"));
  EXPECT_EQ(Place(folder_ / "new/"), Place(folder_ / "new"));
  EXPECT_FALSE(Place(folder_ / "rec/new.csv") == Place(folder_ / "rec/other.csv"));
  EXPECT_FALSE(Place(folder_ / "rec/new.csv") == Place(rec_));
}

TEST_F(Places, LiesInAFolderUnderAnyName) {
  fs::create_directory_symlink(folder_ / "rec/rgb", folder_ / "link");
  EXPECT_TRUE(Place(file_).lies_in(Place(rec_)));
  EXPECT_TRUE(Place(folder_ / "link/a.png").lies_in(Place(rec_)));
  EXPECT_TRUE(Place(folder_ / "link/new/b.png").lies_in(Place(rec_)));
  EXPECT_TRUE(Place(folder_ / "new/a/b").lies_in(Place(folder_ / "new")));
  EXPECT_FALSE(Place(folder_ / "new/a/b").lies_in(Place(folder_ / "new/b")));
  EXPECT_FALSE(Place(rec_).lies_in(Place(rec_)));
  EXPECT_FALSE(Place(folder_ / "recorded").lies_in(Place(rec_)));
  EXPECT_FALSE(Place(rec_).lies_in(Place(file_)));
}

TEST_F(Places, EntriesOfAFolderAreDirectlyInIt) {
  EXPECT_TRUE(Place(folder_ / "rec/rgb").is_entry_of(Place(rec_)));
  EXPECT_TRUE(Place(folder_ / "rec/new").is_entry_of(Place(rec_)));
  EXPECT_TRUE(Place(folder_ / "none/new").is_entry_of(Place(folder_ / "none")));
  EXPECT_FALSE(Place(file_).is_entry_of(Place(rec_)));
  EXPECT_FALSE(Place(folder_ / "rec/none/new").is_entry_of(Place(rec_)));
}

}  // namespace
}  // namespace barehand
