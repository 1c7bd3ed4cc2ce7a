#include "base/interruption_scope.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "base/scheduler.h"

namespace algebra3d {
namespace {

TEST(InterruptionScope, without_a_scope_nothing_is_thrown) {
  EXPECT_FALSE(is_interrupted());
  EXPECT_NO_THROW(poll_interruption());
}

TEST(InterruptionScope, a_set_flag_is_thrown_at_the_next_poll) {
  std::atomic<bool> flag = false;
  const InterruptionScope scope(&flag);
  EXPECT_NO_THROW(poll_interruption());
  flag = true;
  EXPECT_THROW(poll_interruption(), Interrupted);
  flag = false;
  EXPECT_NO_THROW(poll_interruption());
}

TEST(InterruptionScope, is_heard_by_monitors_that_were_given_no_flag) {
  std::atomic<bool> flag = false;
  const InterruptionScope scope(&flag);
  const Monitor monitor;
  Stage stage(monitor, "", 1);
  EXPECT_TRUE(monitor.check());
  flag = true;
  EXPECT_THROW(static_cast<void>(monitor.check()), Interrupted);
  EXPECT_THROW(stage.begin_step(), Interrupted);
}

TEST(InterruptionScope, loops_poll_at_every_1024th_step) {
  const std::atomic<bool> flag = true;
  const InterruptionScope scope(&flag);
  EXPECT_NO_THROW(poll_interruption_at(1023));
  EXPECT_THROW(poll_interruption_at(1024), Interrupted);
}

TEST(InterruptionScope, flags_of_outer_scopes_count_and_scopes_end) {
  std::atomic<bool> outer_flag = false, inner_flag = false;
  {
    const InterruptionScope outer(&outer_flag);
    {
      const InterruptionScope inner(&inner_flag);
      outer_flag = true;
      EXPECT_TRUE(is_interrupted());
      outer_flag = false;
      inner_flag = true;
      EXPECT_TRUE(is_interrupted());
    }
    EXPECT_FALSE(is_interrupted());
  }
  outer_flag = true;
  EXPECT_FALSE(is_interrupted());
}

TEST(InterruptionScope, what_must_come_to_its_end_does) {
  const std::atomic<bool> flag = true;
  const InterruptionScope scope(&flag);
  const UninterruptedScope uninterrupted;
  EXPECT_NO_THROW(poll_interruption());
}

TEST(InterruptionScope, other_threads_are_not_concerned) {
  const std::atomic<bool> flag = true;
  const InterruptionScope scope(&flag);
  bool is_wanted = true;
  std::thread([&] { is_wanted = is_interrupted(); }).join();
  EXPECT_FALSE(is_wanted);
}

struct PollsAtItsEnd {
  explicit PollsAtItsEnd(bool& seen) : has_ended(seen) {}
  ~PollsAtItsEnd() {
    poll_interruption();
    has_ended = true;
  }
  bool& has_ended;
};

// An exception out of a destructor would end the process.
TEST(InterruptionScope, nothing_is_thrown_while_the_stack_unwinds) {
  const std::atomic<bool> flag = true;
  const InterruptionScope scope(&flag);
  bool has_ended = false;
  EXPECT_THROW(
      {
        const PollsAtItsEnd object(has_ended);
        poll_interruption();
      },
      Interrupted);
  EXPECT_TRUE(has_ended);
}

TEST(InterruptionScope, the_exception_becomes_an_error) {
  const std::atomic<bool> flag = true;
  const InterruptionScope scope(&flag);
  const Status status = as_interrupted([]() -> Status {
    poll_interruption();
    return {};
  });
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::interrupted);
}

// The flag is set by the first steps; nearly all others are left out, on whatever threads they would run.
TEST(InterruptionScope, parallel_loops_end) {
  std::atomic<bool> flag = false;
  const InterruptionScope scope(&flag);
  std::atomic<std::size_t> steps = 0;
  constexpr std::size_t kCount = 10'000'000;
  EXPECT_THROW(parallel_for(kCount, 100,
                            [&](std::size_t) {
                              if (++steps == 1000) flag = true;
                            }),
               Interrupted);
  EXPECT_LT(steps, kCount / 100);
  flag = false;
  EXPECT_NO_THROW(parallel_for(1000, 10, [](std::size_t) { poll_interruption(); }));
}

TEST(InterruptionScope, both_sides_of_a_parallel_call_hear_it) {
  const std::atomic<bool> flag = true;
  const InterruptionScope scope(&flag);
  std::atomic<int> heard = 0;
  const auto side = [&] { heard += is_interrupted() ? 1 : 0; };
  parallel_invoke(true, side, side);
  EXPECT_EQ(heard, 2);
}

}  // namespace
}  // namespace algebra3d
