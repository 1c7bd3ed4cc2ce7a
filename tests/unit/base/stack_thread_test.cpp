#include "base/stack_thread.h"

#include <csignal>

#include <gtest/gtest.h>

#include "base/signal_block.h"

namespace algebra3d {
namespace {

std::size_t own_stack_bytes() {
  pthread_attr_t attributes;
  pthread_getattr_np(pthread_self(), &attributes);
  std::size_t bytes = 0;
  pthread_attr_getstacksize(&attributes, &bytes);
  pthread_attr_destroy(&attributes);
  return bytes;
}

TEST(StackThread, has_its_stack_and_can_be_started_again) {
  StackThread thread;
  std::size_t bytes = 0;
  ASSERT_TRUE(thread.start([&] { bytes = own_stack_bytes(); }));
  thread.join();
  EXPECT_GE(bytes, StackThread::kStackBytes);
  thread.join();  // nothing to wait for
  bool has_run = false;
  ASSERT_TRUE(thread.start([&] { has_run = true; }));
  thread.join();
  EXPECT_TRUE(has_run);
}

TEST(SignalBlock, keeps_signals_from_threads_that_are_started_meanwhile) {
  const auto is_blocked = [] {
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
    return sigismember(&blocked, SIGINT) == 1;
  };
  bool within = false;
  {
    const SignalBlock block;
    EXPECT_TRUE(is_blocked());
    EXPECT_EQ(sigismember(&block.before(), SIGINT), 0);
    StackThread thread;
    ASSERT_TRUE(thread.start([&] { within = is_blocked(); }));
  }
  EXPECT_FALSE(is_blocked());
  EXPECT_TRUE(within);
}

}  // namespace
}  // namespace algebra3d
