#include "app/shared/interrupt.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <latch>
#include <semaphore>

namespace barehand {
namespace {

/// Restores the default action of the signals, since the tests may be run by a program that ignores some of them.
class InterruptWatcherTest : public ::testing::Test {
 protected:
  InterruptWatcherTest() {
    for (const int number : {SIGHUP, SIGINT}) std::signal(number, SIG_DFL);
  }
  ~InterruptWatcherTest() override {
    for (const int number : {SIGHUP, SIGINT}) std::signal(number, SIG_DFL);
  }
};

/// Sends the signal with the code SI_KERNEL, as the kernel does for Ctrl+C in a terminal.
void send_from_terminal(int number) {
  siginfo_t info{};
  info.si_signo = number;
  info.si_code = SI_KERNEL;
  ASSERT_EQ(syscall(SYS_rt_sigqueueinfo, getpid(), number, &info), 0);
}

TEST_F(InterruptWatcherTest, CallsOnceAndRemembersTheSignal) {
  std::latch called(1);
  InterruptWatcher watcher([&] { called.count_down(); });
  EXPECT_EQ(watcher.signal(), 0);
  kill(getpid(), SIGTERM);
  called.wait();
  EXPECT_EQ(watcher.signal(), SIGTERM);
}

TEST_F(InterruptWatcherTest, HangupIsACallOfItsOwnAndMayComeAgain) {
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

TEST_F(InterruptWatcherTest, HangupAfterTheStopIsHarmless) {
  std::latch called(1);
  {
    InterruptWatcher watcher([&] { called.count_down(); }, [] { ADD_FAILURE() << "whoever stops does not reload"; });
    kill(getpid(), SIGTERM);
    called.wait();
    kill(getpid(), SIGHUP);
  }
  SUCCEED() << "the process is still there";
}

TEST_F(InterruptWatcherTest, WithoutACallOfItsOwnHangupStops) {
  std::latch called(1);
  InterruptWatcher watcher([&] { called.count_down(); });
  kill(getpid(), SIGHUP);
  called.wait();
  EXPECT_EQ(watcher.signal(), SIGHUP);
  kill(getpid(), SIGHUP);  // a terminal that is closed sends it twice
}

TEST_F(InterruptWatcherTest, HangupCanBeMadeToStop) {
  std::latch called(1);
  InterruptWatcher watcher([&] { called.count_down(); }, [] { ADD_FAILURE() << "it reloads no more"; });
  watcher.stop_on_hangup();
  kill(getpid(), SIGHUP);
  called.wait();
  EXPECT_EQ(watcher.signal(), SIGHUP);
}

TEST_F(InterruptWatcherTest, WhatWasIgnoredAtTheStartStaysIgnored) {
  std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGINT, SIG_IGN);
  std::latch called(1);
  InterruptWatcher watcher([&] { called.count_down(); }, [] { ADD_FAILURE() << "nohup"; });
  kill(getpid(), SIGHUP);
  send_from_terminal(SIGINT);
  // Pending signals are delivered by ascending number, and the ignored ones have smaller numbers.
  kill(getpid(), SIGTERM);
  called.wait();
  EXPECT_EQ(watcher.signal(), SIGTERM);
}

TEST_F(InterruptWatcherTest, InTheBackgroundKillIsMeantForThisProcess) {
  std::signal(SIGINT, SIG_IGN);
  std::latch called(1);
  InterruptWatcher watcher([&] { called.count_down(); });
  kill(getpid(), SIGINT);
  called.wait();
  EXPECT_EQ(watcher.signal(), SIGINT);
}

TEST_F(InterruptWatcherTest, CtrlCOfATerminalStops) {
  std::latch called(1);
  InterruptWatcher watcher([&] { called.count_down(); });
  send_from_terminal(SIGINT);
  called.wait();
  EXPECT_EQ(watcher.signal(), SIGINT);
  EXPECT_EQ(watcher.name(), "Ctrl-C");
}

TEST_F(InterruptWatcherTest, RestoresTheSignalMask) {
  sigset_t before, after;
  pthread_sigmask(SIG_BLOCK, nullptr, &before);
  {
    const InterruptWatcher watcher([] {});
  }
  pthread_sigmask(SIG_BLOCK, nullptr, &after);
  EXPECT_EQ(sigismember(&before, SIGINT), sigismember(&after, SIGINT));
}

TEST_F(InterruptWatcherTest, ASignalBetweenTwoWatchersIsHeldForTheSecond) {
  sigset_t before;
  pthread_sigmask(SIG_BLOCK, nullptr, &before);
  hold_interrupts();
  {
    const InterruptWatcher first([] { ADD_FAILURE() << "it is gone by then"; });
  }
  kill(getpid(), SIGINT);
  {
    std::latch called(1);
    InterruptWatcher second([&] { called.count_down(); });
    called.wait();
    EXPECT_EQ(second.signal(), SIGINT);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

using InterruptWatcherDeathTest = InterruptWatcherTest;

TEST_F(InterruptWatcherDeathTest, SecondSignalEndsTheProcess) {
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
