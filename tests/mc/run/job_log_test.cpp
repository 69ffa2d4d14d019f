#include <mc/run/job_log.h>

#include <mc/run/sum_job.h>
#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using support::expected_sum, support::SumJob;

struct JobLogTest : support::ScratchTest {};

// Runs three jobs, and fails after a number of units. Returns their sums, or nothing where it failed.
std::vector<double> run_three(mc::Checkpoint* checkpoint, int units, int& computed) {
  mc::JobLog log(checkpoint);
  std::vector<double> sums;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SumJob job{.seed = seed, .before = [&](std::size_t) {
                 if (computed++ == units) throw mc::Error("killed");
               }};
    EXPECT_TRUE(mc::run_job(job, {.threads = 1, .executor = log.executor(), .name = std::to_string(seed)}));
    sums.push_back(job.sum);
  }
  log.save();
  return sums;
}

TEST_F(JobLogTest, KilledRun_RepeatsNoFinishedJob) {
  const std::vector<double> expected = {expected_sum(1), expected_sum(2), expected_sum(3)};
  int all = 0;
  EXPECT_EQ(run_three(nullptr, -1, all), expected);
  for (int units = 0; units < all; units += 23) {
    const std::string file = path(std::to_string(units) + ".ckpt");
    int first = 0, second = 0;
    {
      mc::Checkpoint checkpoint({.file = file, .every = 0}, {});
      EXPECT_THROW(run_three(&checkpoint, units, first), mc::Error);
      checkpoint.save_and_wait();
    }
    const bool is_there = std::filesystem::exists(file);
    mc::Checkpoint checkpoint({.file = file, .resume = is_there ? file : ""}, {});
    EXPECT_EQ(run_three(&checkpoint, -1, second), expected);
    EXPECT_LE(second, all);
  }
}

TEST_F(JobLogTest, FinishedRun_ComputesNothing) {
  int first = 0, second = 0;
  const std::string file = path("a.ckpt");
  {
    mc::Checkpoint checkpoint({.file = file}, {});
    run_three(&checkpoint, -1, first);
  }
  mc::Checkpoint checkpoint({.file = file, .resume = file}, {});
  run_three(&checkpoint, -1, second);
  EXPECT_EQ(second, 0);
}

TEST_F(JobLogTest, OtherJob_IsRefused) {
  int computed = 0;
  const std::string file = path("a.ckpt");
  {
    mc::Checkpoint checkpoint({.file = file}, {});
    run_three(&checkpoint, -1, computed);
  }
  mc::Checkpoint checkpoint({.file = file, .resume = file}, {});
  mc::JobLog log(&checkpoint);
  SumJob job;
  EXPECT_THAT(support::error_of([&] { mc::run_job(job, {.executor = log.executor(), .name = "x"}); }),
              testing::HasSubstr("has the job '1' where the run has 'x'"));
}

} // namespace
