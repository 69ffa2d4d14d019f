// Each command is killed by kill -9 at several moments and goes on with the same bits as without an interruption.

#include <tools/content_of.h>
#include <tools/interrupt_carlo.h>
#include <tools/kill_carlo.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <regex>

namespace {

namespace fs = std::filesystem;

using support::content_of, support::run_carlo;
using testing::AllOf;
using testing::HasSubstr;

/// A command with OUT for its output, and the files to compare.
struct KilledLine {
  std::string name, line;
  std::vector<std::string> files;
};

const std::string cbox_file = MC_SOURCE_DIR "/librender/scenes/cbox.xml";

const std::vector<KilledLine> killed_commands = {
    {"render", "render cbox --size 24x24 --spp 37 --intervals OUT.pfm -o OUT.exr", {".exr", ".pfm"}},
    {"adaptive", "render cbox --size 24x20 --spp 40 --adaptive on -o OUT.exr", {".exr"}},
    {"splat", "render cbox --size 20x20 --spp 11 --splat on -o OUT.exr", {".exr"}},
    {"tiles", "render cbox --size 31x20 --crop 3,1,21,18 --spp 40 --tiles on --adaptive on -o OUT.exr", {".exr"}},
    {"stratified", "render cbox --size 16x16 --spp 30 --sampler stratified --strategy nee -o OUT.exr", {".exr"}},
    {"gallery", "gallery cbox smallpt --scale 0.03 --spp 8 -o OUT", {"/cbox.exr", "/smallpt.exr", "/sheet.png"}},
    {"validate", "validate Linear Tent CosineHemisphere --samples 5000 --json OUT.json --report OUT", {".json"}},
    {"integrate",
     "integrate \"exp(-x*x-y)\" -d \"x=0:1,y=0:2\" --rel-error 1e-9 --max-calls 2e6 --json OUT.json",
     {".json"}},
    {"converge", "converge pi x2_uniform --max-n 512 -o OUT", {"/pi.csv", "/x2_uniform.csv"}},
    {"converge_scene",
     "converge " + cbox_file + " --strategies mis --samplers sobol,independent --max-spp 16 --size 6x6 -o OUT",
     {"/cbox.csv"}},
    {"trade", "trade pi --error 1e-2 --max-n 256 -o OUT", {"/trade.csv"}},
    {"trade_scene",
     "trade " + cbox_file + " --strategies mis --samplers sobol --max-spp 32 --size 6x6 --cost rays -o OUT",
     {"/trade.csv", "/front.csv"}}};

struct KilledCommand : support::ScratchTest, testing::WithParamInterface<KilledLine> {
  std::string line(const std::string& out) const {
    return std::regex_replace(GetParam().line, std::regex("OUT"), path(out));
  }
};

TEST_P(KilledCommand, GoesOnWithTheSameBits) {
  const std::string file = path("a.ckpt"), log = path("log");
  const support::ProcessResult whole = run_carlo(line("whole"));
  ASSERT_LE(whole.exit_code, 1) << whole.output;
  int kills = 0;
  for (int first = 1; first <= 4; first += 3) {
    fs::remove(file);
    std::optional<int> code;
    // A later kill each time, so that the run ends.
    for (int times = first; !code; times += 1 + times / 2) {
      const std::string files = (fs::exists(file) ? " --resume '" : " --checkpoint '") + file + "' --every 0";
      code = support::kill_carlo(line("parts") + files, file, times, log);
      kills += !code;
    }
    ASSERT_EQ(*code, whole.exit_code) << mc::read_file(log);
    for (const std::string& name : GetParam().files)
      EXPECT_EQ(content_of(path("parts" + name)), content_of(path("whole" + name))) << name;
    const support::ProcessResult again = run_carlo(line("parts") + " --resume '" + file + "'");
    EXPECT_EQ(again.exit_code, whole.exit_code) << again.output;
  }
  EXPECT_GT(kills, 0);
}

INSTANTIATE_TEST_SUITE_P(Commands, KilledCommand, testing::ValuesIn(killed_commands),
                         [](const auto& one) { return one.param.name; });

struct CheckpointCommand : support::ScratchTest {};

TEST_F(CheckpointCommand, MoreSamples_HaveTheBitsOfOneRun) {
  const std::string small = "render cbox --size 16x16 ", file = path("a.ckpt");
  ASSERT_EQ(run_carlo(small + "--spp 8 -o " + path("a.exr") + " --checkpoint " + file).exit_code, 0);
  ASSERT_EQ(run_carlo(small + "--spp 50 -o " + path("b.exr") + " --resume " + file).exit_code, 0);
  ASSERT_EQ(run_carlo(small + "--spp 50 -o " + path("c.exr")).exit_code, 0);
  EXPECT_EQ(content_of(path("b.exr")), content_of(path("c.exr")));
  EXPECT_NE(content_of(path("b.exr")), content_of(path("a.exr")));
}

TEST_F(CheckpointCommand, OtherSettings_AreRefusedWithWhatDiffers) {
  const std::string small = "render cbox --spp 4 -o " + path("a.exr"), file = path("a.ckpt");
  ASSERT_EQ(run_carlo(small + " --size 16x16 --checkpoint " + file).exit_code, 0);
  const support::ProcessResult render = run_carlo(small + " --size 8x8 --seed 7 --resume " + file);
  EXPECT_EQ(render.exit_code, 2);
  EXPECT_THAT(render.output,
              AllOf(HasSubstr("'" + file + "' is of another run"), HasSubstr("--size was '16x16' and is '8x8' now"),
                    HasSubstr("--seed was '0' and is '7' now")));
  const support::ProcessResult other = run_carlo("validate Linear --resume " + file);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.output, HasSubstr("is of another run"));
  write("a.ckpt", mc::read_file(file).substr(0, 1000));
  EXPECT_THAT(run_carlo(small + " --resume " + file).output, HasSubstr("is damaged: its checksum is wrong"));
  const support::ProcessResult swallowed = run_carlo("render --resume cbox");
  EXPECT_EQ(swallowed.exit_code, 2);
  EXPECT_THAT(swallowed.output, HasSubstr("it stands before --resume, which takes 'cbox'"));
}

// Ctrl-C and SIGTERM write a checkpoint, whatever --every says.
TEST_F(CheckpointCommand, Interrupt_WritesACheckpointFirst) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const std::string file = path("a.ckpt"), line = "render cbox --size 64x64 --spp 2048 -o " + path("a.exr");
    fs::remove(file);
    const support::ProcessResult run =
        support::interrupt_carlo(line + " --every 10h --checkpoint " + file, "  error ", signal);
    EXPECT_EQ(run.exit_code, 128 + signal) << run.output;
    if (signal != SIGHUP) { // which ends the output
      EXPECT_THAT(run.output, HasSubstr("--resume '" + file + "' goes on from here"));
    }
    ASSERT_TRUE(fs::exists(file));
    EXPECT_GT(fs::file_size(file), 64u * 64 * 100);
  }
}

TEST_F(CheckpointCommand, FullDisk_KeepsTheRunGoing) {
  const std::string file = path("a.ckpt");
  write("a.ckpt", "old");
  const support::ProcessResult run =
      support::run("ulimit -f 40; '" CARLO_PATH "' render cbox --size 24x24 --spp 16 --every 0 --checkpoint " + file +
                   " -o " + path("a.exr"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("; the checkpoint before it stays, and the run goes on"));
  EXPECT_EQ(mc::read_file(file), "old");
}

} // namespace
