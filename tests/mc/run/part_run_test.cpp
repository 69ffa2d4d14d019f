#include <mc/run/part_run.h>

#include <mc/run/sum_job.h>
#include <support/files.h>

#include <gmock/gmock.h>

#include <memory>

namespace {

using mc::Part, mc::PartRun;
using support::error_of, support::expected_sum, support::SkippedJob, support::SumJob;
using testing::HasSubstr;

const mc::RunIdentity part_identity = {{"--seed", "1"}};

struct PartRunTest : support::ScratchTest {
  std::string part_file(std::uint64_t k) const { return path("part" + std::to_string(k) + ".ckpt"); }
  std::unique_ptr<mc::Checkpoint> checkpoint(const std::string& file, bool resume = false) const {
    return std::make_unique<mc::Checkpoint>(mc::CheckpointOptions{.file = file, .resume = resume ? file : ""},
                                            part_identity);
  }
  // Runs part k of n. Returns whether the job came to its end.
  template <class J> bool run_part(J& job, Part part, const std::string& base = "") const {
    const auto files = checkpoint(part_file(part.number));
    PartRun run(part, {"carlo", "sum"}, files.get());
    if (!base.empty()) run.add(mc::read_part(base).results);
    bool is_done = false;
    mc::IndependentPieces pieces;
    pieces.attempt([&] { is_done = mc::run_job(job, {.threads = 2, .executor = run.executor()}); });
    run.save(true);
    return is_done;
  }
  // Runs all parts, round by round, until the merged results are complete. Returns the number of rounds.
  template <class J> int run_rounds(J& last, std::uint64_t n) const {
    const std::string all = path("all.ckpt");
    for (int round = 1; round < 50; ++round) {
      std::vector<std::string> names;
      if (round > 1) names.push_back(all);
      for (std::uint64_t k = 1; k <= n; ++k) {
        J job;
        run_part(job, {k, n, std::uint64_t(round)}, round > 1 ? all : "");
        names.push_back(part_file(k));
      }
      std::vector<mc::SavedPart> parts;
      for (const std::string& name : names) parts.push_back(mc::read_part(name));
      mc::require_all_parts(parts);
      const auto files = checkpoint(path("next.ckpt"));
      PartRun merged({.number = 0, .count = 0, .round = std::uint64_t(round)}, {}, files.get());
      for (const mc::SavedPart& one : parts) merged.add(one.results);
      J job;
      mc::IndependentPieces pieces;
      if (pieces.attempt([&] { EXPECT_TRUE(mc::run_job(job, {.executor = merged.executor()})); })) {
        EXPECT_EQ(job.computed, 0);
        last.sum = job.sum;
        return round;
      }
      merged.save(true);
      std::filesystem::rename(path("next.ckpt"), all);
    }
    return 0;
  }
};

TEST_F(PartRunTest, AnyNumberOfParts_GivesTheSameBits) {
  SkippedJob whole;
  ASSERT_TRUE(mc::run_job(whole, {.threads = 1}));
  for (const std::uint64_t n : {1, 2, 3, 17, 40}) {
    SkippedJob merged;
    const int rounds = run_rounds(merged, n);
    EXPECT_EQ(rounds, n == 1 ? 1 : 2) << n; // one barrier: the end of the job is none
    EXPECT_EQ(merged.sum, whole.sum) << n;
  }
}

TEST_F(PartRunTest, JobThatNeedsEveryStage_TakesARoundForEach) {
  SumJob merged;
  EXPECT_EQ(run_rounds(merged, 3), 6);
  EXPECT_EQ(merged.sum, expected_sum(1));
}

TEST_F(PartRunTest, KilledPart_GoesOnFromItsFile) {
  std::atomic<bool> cancel = false;
  SkippedJob first;
  first.before = [&](std::size_t unit) { cancel = cancel || unit == 8; };
  {
    const auto files = checkpoint(part_file(1));
    PartRun run({1, 2}, {}, files.get());
    EXPECT_THROW(mc::run_job(first, {.threads = 1, .cancel = &cancel, .executor = run.executor()}), mc::EndOfPart);
    run.save(false);
  }
  EXPECT_FALSE(mc::read_part(part_file(1)).part.is_whole);
  EXPECT_THAT(error_of([&] { mc::require_all_parts({mc::read_part(part_file(1))}); }),
              HasSubstr("part1.ckpt' did not come to its end; run the command of part 1/2 again"));
  const auto again = [&](bool resume) {
    SkippedJob job;
    const auto files = checkpoint(part_file(1), resume);
    PartRun run({1, 2}, {}, files.get());
    EXPECT_THROW(mc::run_job(job, {.executor = run.executor()}), mc::EndOfPart);
    return int(job.computed);
  };
  const int resumed = again(true);
  EXPECT_EQ(first.computed + resumed, again(false));
  EXPECT_THAT(error_of([&] {
                const auto files = checkpoint(part_file(1), true);
                PartRun({2, 2}, {}, files.get());
              }),
              HasSubstr("it is part 1/2 of round 1, and this is part 2/2 of round 1"));
}

// A stage of four small units, and one of a million units with 1 MB of results each.
struct LargeJob {
  using Result = std::string;
  int stage = 0;
  mutable std::atomic<int> computed = 0;
  std::size_t next_stage() { return ++stage == 1 ? 4 : 1'000'000; }
  std::optional<Result> compute(std::size_t) const {
    ++computed;
    return std::string(stage == 1 ? 1 : 1'000'000, 'x');
  }
  void absorb(std::size_t, const Result&) {}
  template <class Archive> void archive(Archive&) {}
};

TEST_F(PartRunTest, ResultsBeyondTheMemory_AreRefusedAtTheFirstUnitAndEarlierOnesSaved) {
  for (const int known : {0, 4}) { // units in the file
    const auto files = checkpoint(part_file(1), known > 0);
    PartRun run({1, 1}, {}, files.get());
    LargeJob job;
    // Three times: the results and two checkpoints of them.
    EXPECT_THAT(error_of([&] { mc::run_job(job, {.threads = 1, .executor = run.executor()}); }),
                HasSubstr("the results of part 1/1 need 2.79e+03 GiB of memory"));
    EXPECT_EQ(job.computed, 4 - known + 1);
  }
  EXPECT_FALSE(mc::read_part(part_file(1)).part.is_whole);
}

TEST_F(PartRunTest, MissingDoubleAndForeignParts_AreNamed) {
  std::vector<mc::SavedPart> all;
  for (std::uint64_t k = 1; k <= 9; ++k) {
    SkippedJob job;
    run_part(job, {k, 9});
    all.push_back(mc::read_part(part_file(k)));
  }
  EXPECT_EQ(error_of([&] { mc::require_all_parts(all); }), "");
  EXPECT_EQ(all[3].command, (std::vector<std::string>{"carlo", "sum"}));
  const auto refusal = [&](auto change) {
    std::vector<mc::SavedPart> parts = all;
    change(parts);
    return error_of([&] { mc::require_all_parts(parts); });
  };
  EXPECT_THAT(refusal([](auto& p) { p.erase(p.begin() + 2, p.begin() + 5); }), HasSubstr("parts 3-5 of 9 are missing"));
  EXPECT_THAT(refusal([](auto& p) { p.pop_back(); }), HasSubstr("part 9 of 9 is missing"));
  EXPECT_THAT(refusal([](auto& p) { p.push_back(p[1]); }), HasSubstr("are both part 2/9"));
  EXPECT_THAT(refusal([](auto& p) { p[4].identity[0].second = "2"; }),
              HasSubstr("is of another run than '" + part_file(1) + "': --seed was '1' and is '2' now"));
  EXPECT_THAT(refusal([](auto& p) { p[4].part.count = 10; }), HasSubstr("is part 5/10, and others are of 9 parts"));
  EXPECT_THAT(refusal([](auto& p) { p[4].part.round = 2; }), HasSubstr("is of round 2, and others are of round 1"));
  EXPECT_THAT(refusal([](auto& p) {
                for (auto& one : p) one.part.round = 2;
              }),
              HasSubstr("name the merged file of round 1, too"));
}

TEST_F(PartRunTest, WholeRun_IsNoPart) {
  checkpoint(path("whole.ckpt"))->save_and_wait();
  EXPECT_THAT(error_of([&] { mc::read_part(path("whole.ckpt")); }), HasSubstr("is a checkpoint of a whole run"));
  const Part wrong{3, 2};
  EXPECT_THAT(error_of([&] { PartRun(wrong, {}, nullptr); }), HasSubstr("part 3/2 must be one of 1 to 2"));
}

TEST_F(PartRunTest, Piece_IsComputedByOnePartAlone) {
  PartRun first({1, 2}, {}, nullptr), second({2, 2}, {}, nullptr);
  EXPECT_NE(first.is_mine(7), second.is_mine(7));
  SumJob job, other;
  EXPECT_TRUE(mc::run_job(job, {.executor = first.executor(PartRun::Claim::all)}));
  EXPECT_EQ(job.sum, expected_sum(1));
  EXPECT_THROW(mc::run_job(other, {.executor = second.executor(PartRun::Claim::none)}), mc::EndOfPart);
  EXPECT_EQ(other.computed, 0);
}

} // namespace
