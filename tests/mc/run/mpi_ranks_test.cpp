#include <gmock/gmock.h>

#ifdef MC_TEST_MPI

#include <mc/estimate/integrate.h>
#include <mc/run/job.h>
#include <mc/run/mpi_ranks.h>

#include <mc/core/file.h>
#include <mc/run/mpi_program.h>
#include <mc/run/sum_job.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace {

using support::expected_sum, support::SumJob;
using testing::HasSubstr;

// The program of a rank, by its name. Returns the exit code.
int program(const std::string& name, mc::MpiRanks& ranks) {
  const mc::Executor executor = ranks.executor();
  if (name == "jobs") { // more than once, with stages that depend on results
    bool is_right = true;
    for (std::uint64_t seed = 1; seed < 6; ++seed) {
      SumJob job{.seed = seed};
      is_right = mc::run_job(job, {.threads = 2, .executor = executor}) && job.sum == expected_sum(seed) && is_right;
    }
    const double value = mc::shared_value(double(ranks.rank()), executor);
    return is_right && value == 0 ? 0 : 1;
  }
  if (name == "integrate") {
    const auto f = [](std::span<const double> u) { return u[0] * u[0] + (u[1] < 0.3 ? u[2] : 0); };
    for (const mc::Method method : {mc::Method::plain, mc::Method::automatic, mc::Method::tree}) {
      mc::IntegrateOptions o{.rel_error = 1e-9, .max_calls = 300'000, .method = method};
      const mc::Integral alone = mc::integrate_unit(f, 3, o);
      o.executor = executor;
      const mc::Integral together = mc::integrate_unit(f, 3, o);
      if (together.to_string() != alone.to_string() || together.interval.lo != alone.interval.lo) return 1;
    }
    return 0;
  }
  if (name == "early death" && ranks.rank() == 1) std::raise(SIGKILL);
  SumJob job;
  job.before = [&](std::size_t unit) {
    if (name == "error" && unit == 3) throw mc::Error("unit 3");
    if (name != "death") return;
    if (ranks.rank() == 1) std::raise(SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(20)); // so that every rank gets units
  };
  const std::string file = std::string(std::getenv("MC_TEST_FOLDER")) + "/a.ckpt";
  mc::Checkpoint checkpoint({.file = ranks.rank() == 0 ? file : ""}, {});
  try {
    mc::run_job(job, {.checkpoint = &checkpoint,
                      .executor = executor,
                      .name = name == "other name" && ranks.rank() == 1 ? "x" : "sum"});
  } catch (const mc::LostRank& e) {
    mc::write_file(file + ".lost", e.what()); // mpirun may lose what a rank prints before its abort
    return 3;
  } catch (const mc::Error& e) {
    if (ranks.rank() == 0 || name == "error") std::printf("rank %d: %s\n", ranks.rank(), e.what());
    return ranks.rank() == 0 ? 4 : 0;
  } catch (const mc::EndOfRanks&) {
    return 0;
  }
  return 0;
}

const bool has_rank_programs = [] {
  bool all = true;
  for (const char* name : {"jobs", "integrate", "error", "death", "early death", "other name"})
    all = support::add_mpi_program(name,
                                   [name] {
                                     mc::MpiRanks ranks(MPI_COMM_WORLD);
                                     const int code = program(name, ranks);
                                     std::fflush(stdout);
                                     if (!ranks.finish()) MPI_Abort(MPI_COMM_WORLD, code);
                                     return code;
                                   }) &&
          all;
  return all;
}();

using MpiRanks = support::MpiTest;

TEST_F(MpiRanks, AnyNumber_GivesTheSameBits) {
  ASSERT_TRUE(has_rank_programs);
  for (const int ranks : {1, 2, 3, 7})
    for (const char* name : {"jobs", "integrate"}) {
      const support::ProcessResult r = run_mpi(name, ranks);
      EXPECT_EQ(r.exit_code, 0) << name << ' ' << ranks << '\n' << r.output;
    }
}

TEST_F(MpiRanks, ErrorOfAUnit_IsThatOfEveryRank) {
  const support::ProcessResult r = run_mpi("error", 3);
  EXPECT_EQ(r.exit_code, 4) << r.output;
  for (const char* text : {"rank 0: unit 3", "rank 1: unit 3", "rank 2: unit 3"})
    EXPECT_THAT(r.output, HasSubstr(text));
}

TEST_F(MpiRanks, DifferentPrograms_AreRefused) {
  const support::ProcessResult r = run_mpi("other name", 2);
  EXPECT_EQ(r.exit_code, 4) << r.output;
  EXPECT_THAT(r.output, HasSubstr("runs the job '1 x', and rank 0 the job '1 sum': the ranks have different inputs"));
}

// Within a stage, and before a rank has asked for its first unit.
TEST_F(MpiRanks, DeadRank_IsNamedAfterACheckpoint) {
  for (const char* name : {"death", "early death"}) {
    run_mpi(name, 3, "--enable-recovery");
    EXPECT_THAT(mc::read_file(path("a.ckpt.lost")), testing::ContainsRegex("rank 1 \\(process [0-9]+ on [^)]+\\) died"))
        << name;
    for (const char* file : {"a.ckpt", "a.ckpt.lost"}) EXPECT_TRUE(std::filesystem::remove(path(file))) << name << file;
  }
}

} // namespace

#else

TEST(MpiRanks, AnyNumber_GivesTheSameBits) { GTEST_SKIP() << "built without MC_MPI"; }

#endif
