#include <mc/run/work_on_threads.h>

#include <mc/core/error.h>

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <set>

namespace {

// Gives out the numbers below `units`.
struct Numbers {
  std::size_t units;
  std::mutex mutex = {};
  std::size_t next = 0;
  std::set<std::size_t> delivered = {};

  std::optional<std::size_t> take() {
    const std::lock_guard lock(mutex);
    return next < units ? std::optional(next++) : std::nullopt;
  }
  void deliver(std::size_t unit, const mc::AnyResult& result) {
    const std::lock_guard lock(mutex);
    if (result) delivered.insert(unit);
  }
  void close() {
    const std::lock_guard lock(mutex);
    next = units;
  }
};

TEST(WorkOnThreads, DeliversEveryUnit) {
  for (const int threads : {1, 2, 5}) {
    mc::AnyJob job;
    job.compute = [](std::size_t unit) { return std::make_shared<std::size_t>(unit); };
    Numbers numbers{100};
    mc::detail::work_on_threads(job, threads, std::size_t(threads), numbers);
    EXPECT_EQ(numbers.delivered.size(), 100u);
  }
}

TEST(WorkOnThreads, UnitThatGivesUpOrThrows_ClosesTheQueue) {
  mc::AnyJob job;
  job.compute = [](std::size_t unit) { return unit < 5 ? std::make_shared<std::size_t>(unit) : nullptr; };
  Numbers numbers{100};
  mc::detail::work_on_threads(job, 1, 1, numbers);
  EXPECT_EQ(numbers.delivered.size(), 5u);
  job.compute = [](std::size_t) -> mc::AnyResult { throw mc::Error("unit"); };
  Numbers others{100};
  EXPECT_THROW(mc::detail::work_on_threads(job, 2, 2, others), mc::Error);
  EXPECT_EQ(others.next, 100u);
}

} // namespace
