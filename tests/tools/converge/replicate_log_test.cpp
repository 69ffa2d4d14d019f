#include <converge/replicate_log.h>

#include <mc/core/error.h>

#include <support/files.h>

namespace {

using namespace carlo;

struct ReplicateLogTest : support::ScratchTest {
  int calls = 0;
  IntegralTarget target;

  void SetUp() override {
    ScratchTest::SetUp();
    target.integral.name = "counted";
    target.run = [this](const ReplicateTask& task) {
      ++calls;
      if (task.n == 64) throw mc::Error("not finite");
      return Replicates{{double(task.n)}, {double(task.seed)}, {0}};
    };
  }
  std::unique_ptr<mc::Checkpoint> checkpoint(double every = 60) const {
    const std::string file = path("a.ckpt");
    return std::make_unique<mc::Checkpoint>(
        mc::CheckpointOptions{.file = file, .every = every, .resume = std::filesystem::exists(file) ? file : ""},
        mc::RunIdentity{});
  }
  Replicates run(ReplicateLog& log, std::uint64_t n) const {
    return log.run(target, {&sampling_method("random"), n, 1, 0, 1});
  }
};

TEST_F(ReplicateLogTest, FinishedTasks_AreNotRepeated) {
  double elapsed = 0;
  {
    const auto files = checkpoint();
    ReplicateLog log(files.get());
    run(log, 16);
    EXPECT_THROW(run(log, 64), mc::Error);
    run(log, 32);
    elapsed = log.elapsed();
    log.save();
  }
  EXPECT_EQ(calls, 3);
  const auto files = checkpoint();
  ReplicateLog log(files.get());
  EXPECT_EQ(run(log, 16).values, (std::vector<double>{16}));
  EXPECT_THROW(run(log, 64), mc::Error) << "the error is logged, too";
  EXPECT_EQ(run(log, 32).values, (std::vector<double>{32}));
  EXPECT_EQ(calls, 3);
  EXPECT_GE(log.elapsed(), 0.0);
  EXPECT_LT(log.elapsed(), elapsed + 60);
  EXPECT_EQ(run(log, 128).values, (std::vector<double>{128}));
  EXPECT_EQ(calls, 4);
}

TEST_F(ReplicateLogTest, AnotherTask_ForgetsTheRest) {
  {
    const auto files = checkpoint();
    ReplicateLog log(files.get());
    for (const std::uint64_t n : {16, 32, 128}) run(log, n);
    log.save();
  }
  const auto files = checkpoint();
  ReplicateLog log(files.get());
  run(log, 16);
  EXPECT_EQ(run(log, 256).values, (std::vector<double>{256}));
  EXPECT_EQ(run(log, 128).values, (std::vector<double>{128}));
  EXPECT_EQ(calls, 5);
}

// A target that has no units, as a plugin, is saved between its tasks, and when the run is cancelled.
TEST_F(ReplicateLogTest, TargetWithoutUnits_IsSavedBetweenTasks) {
  for (const bool is_cancelled : {false, true}) {
    std::filesystem::remove(path("a.ckpt"));
    const std::atomic<bool> cancel = is_cancelled;
    const auto files = checkpoint(is_cancelled ? 1e9 : 0);
    ReplicateLog log(files.get());
    log.run(target, {&sampling_method("random"), 16, 1, 0, 1, 1, &cancel});
    EXPECT_EQ(files->saves(), 1u);
  }
}

} // namespace
