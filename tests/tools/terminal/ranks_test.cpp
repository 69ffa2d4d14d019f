// carlo under mpirun: the same bits for any number of ranks, and one that dies.

#include <terminal/ranks.h>

#include <tools/content_of.h>
#include <tools/run_carlo.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <vector>

namespace {

using support::content_of, support::run_carlo;
using testing::HasSubstr;

struct CarloRanks : support::ScratchTest {
  void SetUp() override {
    support::ScratchTest::SetUp();
    if (support::run(std::string("mpirun --version")).exit_code != 0) GTEST_SKIP() << "mpirun is not installed";
    if (run(2, "--version", "2>&1").output.find("built without MPI") != std::string::npos)
      GTEST_SKIP() << "built without MC_MPI";
  }
  static support::ProcessResult run(int ranks, const std::string& line, const std::string& more = "") {
    return support::run(
        fmt::format("mpirun --oversubscribe --allow-run-as-root -n {} '" CARLO_PATH "' {} {}", ranks, line, more));
  }
};

TEST(Ranks, OneProcess_IsRankZero) {
  EXPECT_EQ(carlo::rank(), 0);
  EXPECT_EQ(carlo::rank_count(), 1);
  EXPECT_FALSE(carlo::ranks_executor());
}

// A command with OUT for its output, and the files to compare.
struct RanksLine {
  std::string line;
  std::vector<std::string> files;
};

TEST_F(CarloRanks, AnyNumber_GivesTheSameBits) {
  const std::vector<RanksLine> all = {
      {"render cbox --size 24x20 --spp 40 --adaptive on -o OUT.exr", {".exr"}},
      {"gallery cbox smallpt --scale 0.03 --spp 8 -o OUT", {"/cbox.exr", "/smallpt.exr", "/sheet.png"}},
      {"validate Linear Tent --samples 5000 --json OUT.json", {".json"}},
      {"integrate \"exp(-x*x-y)\" -d \"x=0:1,y=0:2\" --rel-error 1e-9 --max-calls 1e6 --json OUT.json", {".json"}},
      {"converge pi x2_uniform --max-n 256 -o OUT", {"/pi.csv"}},
      {"trade pi --error 1e-2 --max-n 128 -o OUT", {}}};
  for (const RanksLine& l : all) {
    const auto named = [&](const std::string& out) { return std::regex_replace(l.line, std::regex("OUT"), path(out)); };
    const support::ProcessResult whole = run_carlo(named("whole"));
    ASSERT_LE(whole.exit_code, 1) << whole.output;
    const bool is_first = &l == &all.front();
    for (const int ranks : is_first ? std::vector<int>{1, 2, 3, 7} : std::vector<int>{3}) {
      const support::ProcessResult r = run(ranks, named("ranks"));
      EXPECT_EQ(r.exit_code, whole.exit_code) << l.line << '\n' << r.output;
      for (const std::string& name : l.files)
        EXPECT_EQ(content_of(path("ranks" + name)), content_of(path("whole" + name))) << ranks << ": " << l.line;
    }
  }
}

TEST_F(CarloRanks, BadInput_IsOneLine) {
  const support::ProcessResult r = run(3, "render no-such-scene -o " + path("a.exr"), "2>&1 | grep carlo:");
  EXPECT_EQ(std::count(r.output.begin(), r.output.end(), '\n'), 1) << r.output;
  EXPECT_THAT(r.output, HasSubstr("no-such-scene"));
}

TEST_F(CarloRanks, Checkpoint_GoesOnWithAnotherNumberOfRanks) {
  const std::string line = "render cbox --size 24x20 -o " + path("a.exr"), file = path("a.ckpt");
  ASSERT_EQ(run(2, line + " --spp 8 --checkpoint " + file).exit_code, 0);
  ASSERT_EQ(run(3, line + " --spp 64 --resume " + file).exit_code, 0);
  ASSERT_EQ(run_carlo("render cbox --size 24x20 --spp 64 -o " + path("b.exr")).exit_code, 0);
  EXPECT_EQ(content_of(path("a.exr")), content_of(path("b.exr")));
}

// mpirun ends all ranks where one is killed; rank 0 saves what is done first, and names the rank.
TEST_F(CarloRanks, DeadRank_IsNamedAndTheCheckpointGoesOn) {
  const std::string line = "render cbox --size 64x64 --spp 400 -o " + path("a.exr") + " --threads 1",
                    file = path("a.ckpt");
  const support::ProcessResult r = support::run(
      fmt::format("(mpirun --oversubscribe --allow-run-as-root --mca odls_base_sigkill_timeout 5 -n 3 '" CARLO_PATH
                  "' {} --every 10h --checkpoint {} & run=$!; sleep 1; "
                  "for p in $(pgrep -P $run); do tr '\\0' '\\n' </proc/$p/environ | grep -q "
                  "'^OMPI_COMM_WORLD_RANK=2$' && kill -9 $p; "
                  "done; wait $run)",
                  line, file));
  EXPECT_NE(r.exit_code, 0);
  EXPECT_THAT(r.output, testing::ContainsRegex("carlo: rank 2 \\(process [0-9]+ on [^)]+\\) died"));
  ASSERT_TRUE(std::filesystem::exists(file)) << r.output;
  ASSERT_EQ(run_carlo(line + " --resume " + file).exit_code, 0);
  ASSERT_EQ(run_carlo("render cbox --size 64x64 --spp 400 -o " + path("b.exr")).exit_code, 0);
  EXPECT_EQ(content_of(path("a.exr")), content_of(path("b.exr")));
}

TEST_F(CarloRanks, PartsAndMerge_RunOnOneRank) {
  EXPECT_THAT(run(2, "render cbox --part 1/2 -o a.ckpt").output, HasSubstr("leave out mpirun"));
  EXPECT_THAT(run(2, "merge a.ckpt").output, HasSubstr("leave out mpirun"));
}

} // namespace
