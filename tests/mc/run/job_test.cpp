#include <mc/run/job.h>

#include <mc/core/file.h>
#include <mc/core/parallel.h>
#include <mc/random/hash.h>

#include <mc/run/sum_job.h>
#include <support/files.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <memory>
#include <set>
#include <thread>

namespace {

using mc::Checkpoint, mc::RunOptions;

using support::expected_sum, support::SumJob;

// A function that calls `act` at its call number n, from 0.
std::function<void(std::size_t)> after(int n, const std::function<void()>& act) {
  const auto left = std::make_shared<std::atomic<int>>(n);
  return [left, act](std::size_t) {
    if ((*left)-- == 0) act();
  };
}

struct JobTest : support::ScratchTest {
  std::string file() const { return path("a.ckpt"); }
  mc::CheckpointOptions files(double every = 0) const {
    return {.file = file(), .every = every, .resume = std::filesystem::exists(file()) ? file() : ""};
  }
  // Runs the job from the file if there is one. Returns whether it is done.
  bool run(SumJob& job, int threads, const std::atomic<bool>* cancel = nullptr) const {
    Checkpoint checkpoint(files(), {{"--seed", std::to_string(job.seed)}});
    return mc::run_job(job, {threads, cancel, &checkpoint});
  }
};

TEST_F(JobTest, AnyNumberOfThreads_GivesTheSameBits) {
  for (std::uint64_t seed = 1; seed < 20; ++seed)
    for (const int threads : {1, 2, 7}) {
      SumJob job{.seed = seed};
      EXPECT_TRUE(mc::run_job(job, {.threads = threads}));
      EXPECT_EQ(job.sum, expected_sum(seed));
    }
}

/// A job whose first unit ends last.
struct Slow {
  using Result = int;
  bool has_begun = false;
  mutable std::atomic<std::size_t> others = 0;
  std::vector<std::size_t> order = {};
  std::size_t next_stage() { return std::exchange(has_begun, true) ? 0 : 6000; }
  std::optional<int> compute(std::size_t unit) const {
    if (unit > 0) ++others;
    while (unit == 0 && others + 1 < mc::max_waiting_results(2)) std::this_thread::yield();
    return 0;
  }
  void absorb(std::size_t unit, int) { order.push_back(unit); }
  template <class Archive> void archive(Archive& a) { a(has_begun); }
};

// The first unit ends only when max_waiting_results() - 1 others wait for it.
TEST_F(JobTest, SlowUnit_IsAbsorbedFirst) {
  if (mc::hardware_threads() < 2) GTEST_SKIP() << "one thread computes the units in order";
  Slow slow;
  EXPECT_TRUE(mc::run_job(slow, {.threads = 2}));
  ASSERT_EQ(slow.order.size(), 6000u);
  EXPECT_TRUE(std::is_sorted(slow.order.begin(), slow.order.end()));
}

// kill -9 at every unit in turn, in a process of its own; each run goes on from the file that the killed run left.
TEST_F(JobTest, KilledAtAnyUnit_GoesOnWithTheSameBits) {
  const double expected = expected_sum(5);
  int kills = 0;
  for (int limit = 1; limit < 400; limit += 7, ++kills) {
    std::filesystem::remove(file());
    int status = 0;
    for (int n = limit;; n = 2 * n + 20) { // a later kill each time, so that the run ends
      const pid_t child = fork();
      if (child == 0) {
        SumJob job{.seed = 5, .before = after(n, [] { std::raise(SIGKILL); })};
        const bool done = run(job, 1);
        _exit(done && job.sum == expected ? 0 : 1);
      }
      waitpid(child, &status, 0);
      if (!WIFSIGNALED(status)) break;
    }
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << limit;
  }
  EXPECT_GT(kills, 50);
}

// Results behind a unit that gave up are in the file, and are not computed again.
TEST_F(JobTest, Cancelled_KeepsEveryResult) {
  for (const int threads : {1, 2, 5}) {
    std::filesystem::remove(file());
    std::atomic<bool> cancel = false;
    SumJob first{.seed = 9, .before = [&](std::size_t unit) { cancel = cancel || unit == 20; }};
    ASSERT_FALSE(run(first, threads, &cancel));
    SumJob second{.seed = 9};
    ASSERT_TRUE(run(second, threads));
    EXPECT_EQ(second.sum, expected_sum(9));
    EXPECT_EQ(first.computed + second.computed, int(second.absorbed));
  }
}

struct GivesUp : SumJob {
  std::size_t at = ~std::size_t{0};
  std::atomic<bool>* cancel = nullptr;
  std::set<std::size_t> absorbed_units = {};
  std::optional<Result> compute(std::size_t unit) const {
    if (stage == 2 && unit == at) {
      *cancel = true;
      return {};
    }
    if (stage == 2 && unit > at + 3) // others go on until the unit gave up
      while (cancel && !*cancel) std::this_thread::yield();
    return SumJob::compute(unit);
  }
  void absorb(std::size_t unit, const Result& r) {
    if (stage == 2) absorbed_units.insert(unit);
    SumJob::absorb(unit, r);
  }
};

TEST_F(JobTest, UnitThatGaveUp_IsComputedAgain) {
  std::atomic<bool> cancel = false;
  GivesUp first;
  first.seed = 9;
  first.at = 5;
  first.cancel = &cancel;
  {
    Checkpoint checkpoint(files(), {});
    ASSERT_FALSE(mc::run_job(first, {4, &cancel, &checkpoint}));
  }
  EXPECT_FALSE(first.absorbed_units.contains(5));
  const std::string bytes = mc::read_file(file());
  for (const int threads : {1, 4}) {
    write("a.ckpt", bytes);
    GivesUp second;
    second.seed = 9;
    Checkpoint checkpoint(files(), {});
    ASSERT_TRUE(mc::run_job(second, {threads, nullptr, &checkpoint}));
    EXPECT_EQ(second.sum, expected_sum(9));
    EXPECT_EQ(first.computed + second.computed, int(second.absorbed));
  }
}

TEST_F(JobTest, Exception_EndsTheRun) {
  for (const int threads : {1, 3}) {
    std::filesystem::remove(file());
    SumJob job{.seed = 3, .before = [](std::size_t unit) {
                 if (unit == 9) throw mc::Error("unit 9");
               }};
    EXPECT_EQ(support::error_of([&] { run(job, threads); }), "unit 9");
    SumJob again{.seed = 3};
    EXPECT_TRUE(run(again, threads)); // from the last checkpoint
    EXPECT_EQ(again.sum, expected_sum(3));
  }
}

TEST_F(JobTest, FinishedRun_GoesOnWithMoreStages) {
  SumJob few{.seed = 4, .stages = 3};
  ASSERT_TRUE(run(few, 2));
  SumJob same{.seed = 4, .stages = 3};
  ASSERT_TRUE(run(same, 2));
  EXPECT_EQ(same.computed, 0);
  EXPECT_EQ(same.sum, few.sum);
  SumJob more{.seed = 4};
  ASSERT_TRUE(run(more, 2));
  EXPECT_EQ(more.sum, expected_sum(4));
}

/// A stage of 100 units, of which no more than a number may start.
struct Limited : SumJob {
  std::uint64_t most = 10;
  std::size_t next_stage() { return stage++ < 2 ? 100 : 0; }
  bool may_start() const { return absorbed < most; }
};

TEST_F(JobTest, EndOfTime_EndsTheStage) {
  Limited job;
  EXPECT_TRUE(mc::run_job(job, {.threads = 1}));
  EXPECT_EQ(job.absorbed, 10u);
  EXPECT_EQ(job.stage, 3u);
}

/// A program with state around two jobs.
struct Program {
  std::vector<double> sums = {};
  bool run(Checkpoint& checkpoint, int kill_after, int threads) {
    const Checkpoint::Section section(&checkpoint, "program", [this](auto& a) { a(sums); });
    const auto before = after(kill_after, [] { throw mc::Error("killed"); });
    while (sums.size() < 4) {
      SumJob job{.seed = sums.size(), .before = before};
      if (!mc::run_job(job, {threads, nullptr, &checkpoint})) return false;
      sums.push_back(job.sum);
    }
    return true;
  }
};

TEST_F(JobTest, JobWithinAProgram_GoesOnWhereItWas) {
  std::vector<double> expected;
  for (std::uint64_t seed = 0; seed < 4; ++seed) expected.push_back(expected_sum(seed));
  for (int kill = 5; kill < 700; kill += 41) {
    std::filesystem::remove(file());
    bool is_done = false;
    for (int run = 0; run < 200 && !is_done; ++run) {
      Program program;
      try {
        Checkpoint checkpoint(files(), {});
        is_done = program.run(checkpoint, kill + 100 * run, 1 + run % 3); // later each time, so that it ends
      } catch (const mc::Error& e) {
        ASSERT_STREQ(e.what(), "killed");
      }
      if (is_done) {
        EXPECT_EQ(program.sums, expected) << kill;
      }
    }
    EXPECT_TRUE(is_done);
  }
}

} // namespace
