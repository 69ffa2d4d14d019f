// Runs in parts, merged by carlo merge: the same bits as one run.

#include <tools/content_of.h>
#include <tools/run_carlo.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <filesystem>
#include <regex>

namespace {

namespace fs = std::filesystem;

using support::content_of, support::run_carlo;
using testing::AllOf;
using testing::HasSubstr;

const std::string cbox_file = MC_SOURCE_DIR "/librender/scenes/cbox.xml";

/// A command of which merge writes OUT.
struct PartsLine {
  std::string name, line;
  std::string output; ///< option of the merged output, with OUT; empty: none
  int rounds;         ///< of parts, at most
  std::vector<std::string> files;
};

const std::vector<PartsLine> parts_lines = {
    {"render", "render cbox --size 24x24 --spp 37 --intervals OUT.pfm", "-o OUT.exr", 2, {".exr", ".pfm"}},
    {"even", "render cbox --size 24x20 --spp 40 --adaptive off", "-o OUT.exr", 1, {".exr"}},
    {"target", "render cbox --size 16x16 --target-error 0.1", "-o OUT.exr", 20, {".exr"}},
    {"splat", "render cbox --size 20x20 --spp 11 --splat on", "-o OUT.exr", 1, {".exr"}},
    {"gallery",
     "gallery cbox smallpt smallpt-nee --scale 0.03 --spp 8",
     "-o OUT",
     1,
     {"/cbox.exr", "/smallpt.exr", "/sheet.png"}},
    {"validate", "validate Linear Tent --samples 5000 --json OUT.json --report OUT", "", 1, {".json"}},
    {"integrate",
     "integrate \"exp(-x*x-y)\" -d \"x=0:1,y=0:2\" --rel-error 1e-9 --max-calls 1e6 --json OUT.json",
     "",
     10,
     {".json"}},
    {"converge", "converge pi x2_uniform --max-n 256", "-o OUT", 2, {"/pi.csv"}},
    {"converge_scene",
     "converge " + cbox_file + " --strategies mis --samplers sobol,independent --max-spp 16 --size 6x6",
     "-o OUT",
     30,
     {"/cbox.csv"}},
    {"trade", "trade pi --error 1e-2 --max-n 256", "-o OUT", 2, {}}};

struct MergedCommand : support::ScratchTest, testing::WithParamInterface<PartsLine> {
  std::string with_output(const std::string& text, const std::string& out) const {
    return std::regex_replace(text, std::regex("OUT"), path(out));
  }
};

TEST_P(MergedCommand, HasTheBitsOfOneRun) {
  const PartsLine& p = GetParam();
  const support::ProcessResult whole = run_carlo(with_output(p.line + " " + p.output, "whole"));
  ASSERT_LE(whole.exit_code, 1) << whole.output;
  const std::string all = path("all.ckpt"), line = with_output(p.line, "merged");
  std::string files, resume;
  support::ProcessResult merged;
  int round = 0;
  do {
    ++round;
    files = resume.empty() ? "" : all;
    for (const char* k : {"1", "2", "3"}) {
      const std::string part = path(std::string("part") + k + ".ckpt");
      const support::ProcessResult run = run_carlo(line + resume + " --part " + k + "/3 -o " + part);
      ASSERT_EQ(run.exit_code, 0) << run.output;
      EXPECT_THAT(run.output, HasSubstr("carlo merge puts all parts together"));
      files += " " + part;
    }
    merged = run_carlo("merge " + files + " --checkpoint " + all + " " + with_output(p.output, "merged"));
    resume = " --resume " + all;
  } while (merged.output.find("run the parts again") != std::string::npos && round < p.rounds);
  EXPECT_EQ(merged.exit_code, whole.exit_code) << merged.output;
  for (const std::string& name : p.files)
    EXPECT_EQ(content_of(path("merged" + name)), content_of(path("whole" + name))) << name;
}

INSTANTIATE_TEST_SUITE_P(Commands, MergedCommand, testing::ValuesIn(parts_lines),
                         [](const auto& one) { return one.param.name; });

struct MergeCommand : support::ScratchTest {
  support::ProcessResult part(const std::string& k, const std::string& more = "") const {
    return run_carlo("validate Linear --samples 1000 " + more + " --part " + k + "/3 -o " + path("p" + k + ".ckpt"));
  }
};

TEST_F(MergeCommand, MissingDoubleAndForeignParts_AreNamed) {
  for (const char* k : {"1", "2", "3"}) ASSERT_EQ(part(k).exit_code, 0);
  const auto merged = [&](const std::string& names) {
    std::string files;
    for (const char k : names) files += " " + path(std::string("p") + k + ".ckpt");
    return run_carlo("merge" + files);
  };
  EXPECT_EQ(merged("123").exit_code, 0);
  EXPECT_EQ(merged("13").exit_code, 2);
  EXPECT_THAT(merged("13").output, HasSubstr("part 2 of 3 is missing"));
  EXPECT_THAT(merged("1233").output, HasSubstr("are both part 3/3"));
  fs::remove(path("p2.ckpt"));
  ASSERT_EQ(part("2", "--seed 5").exit_code, 0);
  EXPECT_THAT(merged("123").output,
              AllOf(HasSubstr("p2.ckpt' is of another run than"), HasSubstr("--seed was '1' and is '5' now")));
  EXPECT_THAT(part("2").output, HasSubstr("is of another run: --seed was '5' and is '1' now"));
}

TEST_F(MergeCommand, BadParts_AreRefused) {
  const auto refusal = [](const std::string& line) {
    const support::ProcessResult r = run_carlo(line);
    EXPECT_EQ(r.exit_code, 2) << line;
    return r.output;
  };
  for (const char* text : {"0/3", "4/3", "3", "x", "1/0", "1/3x", "-1/3", "1/1e9"})
    EXPECT_THAT(refusal("validate Linear --part " + std::string(text) + " -o a.ckpt"), HasSubstr("such as 3/100"));
  EXPECT_THAT(refusal("render cbox --part 1/2 -o a.exr"), HasSubstr("give -o part1.ckpt"));
  EXPECT_THAT(refusal("render cbox --time 3 --part 1/2 -o a.ckpt"), HasSubstr("exclude each other"));
  EXPECT_THAT(refusal("validate Linear --part 1/2 --checkpoint b.ckpt -o a.ckpt"), HasSubstr("leave out --checkpoint"));
  EXPECT_THAT(refusal("merge " + path("none.ckpt")), HasSubstr("none.ckpt"));
  ASSERT_EQ(run_carlo("validate Linear --samples 1000 --checkpoint " + path("whole.ckpt")).exit_code, 0);
  EXPECT_THAT(refusal("merge " + path("whole.ckpt")), HasSubstr("is a checkpoint of a whole run"));
  ASSERT_EQ(part("1").exit_code, 0);
  EXPECT_THAT(refusal("validate Linear --samples 1000 --resume " + path("p1.ckpt")),
              HasSubstr("it is a part of a run"));
  EXPECT_THAT(refusal("validate Linear --samples 1000 --part 2/3 -o a.ckpt --resume " + path("p1.ckpt")),
              HasSubstr("name the file that carlo merge wrote"));
}

// The scripts of examples/cluster: GNU parallel, and Slurm by programs that only note how they were called.
TEST_F(MergeCommand, ScriptsForClusters_HaveTheBitsOfOneRun) {
  const std::string scripts = MC_SOURCE_DIR "/examples/cluster/",
                    line = "render cbox --size 16x16 --spp 40 --adaptive on",
                    begin = "cd '" + path("") + "' && CARLO='" CARLO_PATH "' ";
  ASSERT_EQ(run_carlo(line + " -o " + path("whole.exr")).exit_code, 0);
  if (support::run(std::string("command -v parallel")).exit_code == 0) {
    const support::ProcessResult r = support::run(begin + scripts + "parallel.sh 3 a.exr " + line);
    EXPECT_EQ(r.exit_code, 0) << r.output;
    EXPECT_EQ(content_of(path("a.exr")), content_of(path("whole.exr")));
  }
  std::string base;
  for (const std::string job : {"7", "8"})
    for (const std::string k : {"1", "2", "3"}) {
      for (const char* name : {"sbatch", "scontrol", "squeue"})
        fs::permissions(write(name, "#!/bin/sh\necho \"$CARLO_BASE\" >base\n"), fs::perms::owner_all);
      const support::ProcessResult r = support::run(
          begin + "PATH=.:$PATH SLURM_ARRAY_JOB_ID=" + job + " SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_ID=" + k +
          " SLURM_CPUS_PER_TASK=1 CARLO_BASE='" + base + "' " + scripts + "slurm.sh b.exr " + line);
      EXPECT_LE(r.exit_code, 1) << r.output;
      if (k == "3" && job == "7") base = mc::read_file(path("base"));
      if (!base.empty() && base.back() == '\n') base.pop_back();
    }
  EXPECT_EQ(base, "carlo-parts-7/all.ckpt");
  EXPECT_EQ(content_of(path("b.exr")), content_of(path("whole.exr")));
}

// The command of a picture says how one run would have made it.
TEST_F(MergeCommand, Picture_HasTheCommandOfOneRun) {
  const std::string out = path("a b.exr");
  for (const char* k : {"1", "2"})
    ASSERT_EQ(
        run_carlo(std::string("render cbox --size 8x8 --spp 2 --part ") + k + "/2 -o " + path(k) + ".ckpt").exit_code,
        0);
  ASSERT_EQ(run_carlo("merge " + path("1.ckpt") + " " + path("2.ckpt") + " -o '" + out + "'").exit_code, 0);
  EXPECT_EQ(render::read_image(out).metadata.at("carlo.command"),
            "carlo render cbox --size 8x8 --spp 2 -o '" + out + "'");
}

} // namespace
