#include "app/interrupt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <latch>
#include <semaphore>

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

TEST(InterruptWatcher, HangupIsACallOfItsOwnAndMayComeAgain) {
  std::binary_semaphore hung_up(0);
  int stopped = 0;
  InterruptWatcher watcher([&] { ++stopped; }, [&] { hung_up.release(); });
  for (int i = 0; i < 3; ++i) {
    kill(getpid(), SIGHUP);
    hung_up.acquire();
  }
  EXPECT_EQ(watcher.signal(), 0);
  EXPECT_EQ(stopped, 0);
}

TEST(InterruptWatcher, HangupAfterTheStopIsHarmless) {
  std::latch called(1);
  {
    InterruptWatcher watcher([&] { called.count_down(); }, [] { ADD_FAILURE() << "whoever stops does not reload"; });
    kill(getpid(), SIGTERM);
    called.wait();
    kill(getpid(), SIGHUP);
  }
  SUCCEED() << "the process is still there";
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
