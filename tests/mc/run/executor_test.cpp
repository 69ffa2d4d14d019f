#include <mc/run/executor.h>

#include <mc/run/sum_job.h>

#include <gtest/gtest.h>

namespace {

using support::expected_sum, support::SumJob;

// A user's executor: units in reverse order, results as bytes.
bool run_backwards(const mc::AnyJob& job, const mc::RunOptions&) {
  for (std::size_t units; (units = job.next_stage()) > 0;) {
    std::vector<std::string> results(units);
    for (std::size_t i = units; i-- > 0;) {
      mc::ArchiveWriter writer;
      job.write_result(writer, job.compute(i));
      results[i] = writer.take();
    }
    for (std::size_t i = 0; i < units; ++i) {
      mc::ArchiveReader reader(results[i]);
      job.absorb(i, job.read_result(reader));
    }
  }
  return true;
}

TEST(Executor, OfAUser_GivesTheSameBits) {
  SumJob job{.seed = 3};
  EXPECT_TRUE(mc::run_job(job, {.executor = run_backwards}));
  EXPECT_EQ(job.sum, expected_sum(3));
  SumJob threads{.seed = 3};
  EXPECT_TRUE(mc::run_job(threads, {.executor = mc::run_on_threads}));
  EXPECT_EQ(threads.sum, expected_sum(3));
}

TEST(Executor, SharedValue_IsItselfOnThreads) {
  EXPECT_EQ(mc::shared_value(2.5, {}), 2.5);
  EXPECT_EQ(mc::shared_value(2.5, mc::run_on_threads), 2.5);
}

// The queue gives out at most as many units from the first that is not absorbed on as it was opened for. It absorbs in
// order.
TEST(UnitQueue, BoundsTheResultsThatWait) {
  SumJob job{.seed = 2, .stages = 9};
  const mc::AnyJob any = mc::detail::any_job(job, "sum");
  const mc::RunOptions options;
  mc::detail::UnitQueue queue(any, options);
  std::size_t most = 0;
  while (queue.begin_stage()) {
    queue.open(5);
    std::vector<std::size_t> taken;
    while (const auto unit = queue.try_take()) taken.push_back(*unit);
    most = std::max(most, taken.size());
    for (std::size_t i = taken.size(); i-- > 0;) queue.deliver(taken[i], any.compute(taken[i]));
    while (const auto unit = queue.take()) queue.deliver(*unit, any.compute(*unit));
    EXPECT_EQ(queue.left(), 0u);
    EXPECT_TRUE(queue.is_over());
  }
  EXPECT_EQ(most, 5u);
  EXPECT_TRUE(queue.is_done());
  EXPECT_FALSE(queue.is_cancelled());
  SumJob same{.seed = 2, .stages = 9};
  ASSERT_TRUE(mc::run_job(same, {.threads = 1}));
  EXPECT_EQ(job.sum, same.sum);
}

TEST(UnitQueue, WorkerThatGivesUp_CancelsTheRun) {
  SumJob job;
  const mc::AnyJob any = mc::detail::any_job(job, "sum");
  const mc::RunOptions options;
  mc::detail::UnitQueue queue(any, options);
  ASSERT_TRUE(queue.begin_stage());
  queue.open(1);
  queue.deliver(*queue.take(), nullptr);
  EXPECT_TRUE(queue.is_cancelled());
  EXPECT_FALSE(queue.take().has_value());
}

// Another thread may deliver a result before the one that failed has closed the queue.
TEST(UnitQueue, FailureToAbsorb_EndsTheJob) {
  SumJob job;
  mc::AnyJob any = mc::detail::any_job(job, "sum");
  any.absorb = [&](std::size_t unit, const mc::AnyResult& result) {
    EXPECT_TRUE(result);
    if (unit == 1) throw mc::Error("full");
    ++job.absorbed;
  };
  const mc::RunOptions options;
  mc::detail::UnitQueue queue(any, options);
  job.sum = 0.5; // more than one unit
  ASSERT_TRUE(queue.begin_stage());
  queue.open(4);
  for (std::size_t i = 0; i < 4; ++i) ASSERT_EQ(queue.take(), i);
  queue.deliver(0, any.compute(0));
  EXPECT_FALSE(queue.has_failed());
  EXPECT_THROW(queue.deliver(1, any.compute(1)), mc::Error);
  EXPECT_TRUE(queue.has_failed());
  for (const std::size_t late : {2, 3}) queue.deliver(late, any.compute(late));
  EXPECT_FALSE(queue.take().has_value());
  EXPECT_EQ(job.absorbed, 1u);
}

} // namespace
