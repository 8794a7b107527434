#include "io/file_lock.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

class FileLockTest : public ::testing::Test {
 protected:
  const test::TempFolder folder_;
  const std::string path_ = folder_ / ".take.lock";
};

TEST_F(FileLockTest, TheSecondIsToldWhoHasIt) {
  const auto first = FileLock::take(path_, 0ms);
  ASSERT_TRUE(first) << first.error().message();
  const auto second = FileLock::take(path_, 0ms);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message(), HasSubstr("is held by process " + std::to_string(getpid()) + " on "));
  EXPECT_FALSE(FileLock::take(path_, 0ms)) << "being refused does not take it away";
}

TEST_F(FileLockTest, NothingIsLeftOfIt) {
  { const auto lock = FileLock::take(path_, 0ms); }
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_TRUE(FileLock::take(path_, 0ms));
}

TEST_F(FileLockTest, WhatAKilledProcessLeftIsNoObstacle) {
  if (const pid_t child = fork(); child == 0) {
    const auto lock = FileLock::take(path_, 0ms);
    _exit(lock ? 0 : 1);  // ends without destructors, as if killed
  } else {
    int status = -1;
    waitpid(child, &status, 0);
    ASSERT_EQ(status, 0);
  }
  EXPECT_TRUE(fs::exists(path_));
  const auto lock = FileLock::take(path_, 0ms);
  EXPECT_TRUE(lock) << lock.error().message();
}

TEST_F(FileLockTest, WaitsForOneThatIsAboutToEnd) {
  std::optional<FileLock> first = std::move(*FileLock::take(path_, 0ms));
  std::jthread end([&] { first.reset(); });
  EXPECT_TRUE(FileLock::take(path_, 10s));
}

TEST_F(FileLockTest, ManyInTurnNeverHaveItTogether) {
  std::atomic<int> inside = 0, most = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        for (int i = 0; i < 50;) {
          const auto lock = FileLock::take(path_, 0ms);
          if (!lock) continue;
          most = std::max<int>(most, ++inside);
          --inside;
          ++i;
        }
      });
  }
  EXPECT_EQ(most, 1);
}

TEST_F(FileLockTest, MovingOneMovesTheLock) {
  auto first = std::move(*FileLock::take(path_, 0ms));
  FileLock second = std::move(first);
  EXPECT_FALSE(FileLock::take(path_, 0ms));
  first = std::move(second);
  EXPECT_FALSE(FileLock::take(path_, 0ms));
}

TEST_F(FileLockTest, AFolderThatIsNotThereIsAnError) {
  const auto lock = FileLock::take(folder_ / "none/.lock", 0ms);
  ASSERT_FALSE(lock);
  EXPECT_THAT(lock.error().message(), HasSubstr("No such file or directory"));
}

}  // namespace
}  // namespace barehand
