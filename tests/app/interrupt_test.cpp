#include "app/interrupt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <latch>

namespace barehand {
namespace {

TEST(InterruptWatcher, CallsOnceAndRemembersTheSignal) {
  std::latch called(1);
  InterruptWatcher watcher([&] { called.count_down(); });
  EXPECT_EQ(watcher.signal(), 0);
  kill(getpid(), SIGTERM);
  called.wait();
  EXPECT_EQ(watcher.signal(), SIGTERM);
}

TEST(InterruptWatcher, RestoresTheSignalMask) {
  sigset_t before, after;
  pthread_sigmask(SIG_BLOCK, nullptr, &before);
  {
    const InterruptWatcher watcher([] {});
  }
  pthread_sigmask(SIG_BLOCK, nullptr, &after);
  EXPECT_EQ(sigismember(&before, SIGINT), sigismember(&after, SIGINT));
}

TEST(InterruptWatcherDeathTest, SecondSignalEndsTheProcess) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        std::latch called(1);
        InterruptWatcher watcher([&] { called.count_down(); });
        kill(getpid(), SIGINT);
        called.wait();
        kill(getpid(), SIGINT);
        while (true) pause();
      },
      ::testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace barehand
