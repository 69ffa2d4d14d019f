// carlo trade: errors, budgets, output files, and bad input. Times are not asserted.

#include <tools/interrupt_carlo.h>
#include <tools/run_carlo.h>

#include <support/files.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <algorithm>

namespace {

using support::ProcessResult;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

struct TradeCommand : support::ScratchTest {
  ProcessResult run(const std::string& arguments) const {
    return support::run_carlo("trade " + arguments + " -o '" + path("out") + "'");
  }
  void expect_refused(const std::string& arguments, const std::string& words) const {
    const ProcessResult refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments << "\n" << refused.output;
    EXPECT_EQ(std::count(refused.output.begin(), refused.output.end(), '\n'), 1) << refused.output;
    EXPECT_THAT(refused.output, HasSubstr(words));
  }
};

TEST_F(TradeCommand, NamesTheCheapestMethodForEachError) {
  const ProcessResult r = run("rate_smooth_2d --error 0.1,0.01 --max-n 2048 --report '" + path("page") + "'");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("23 methods"), HasSubstr("  error 0.1: "), HasSubstr("  error 0.01: "),
                              HasSubstr("times faster than plain Monte Carlo")));
  const std::string json = mc::read_file(path("out/trade.json"));
  EXPECT_THAT(json, AllOf(HasSubstr("\"way\": \"sobol_float\""), HasSubstr("\"gain_over_plain\""),
                          HasSubstr("\"front\": "), HasSubstr("\"seed\": 1")));
  EXPECT_THAT(mc::read_file(path("out/front.csv")), HasSubstr("way,n,cpu_seconds,rms_error"));
  EXPECT_THAT(mc::read_file(path("page/index.html")), AllOf(HasSubstr("<th>cost of plain Monte Carlo</th>"),
                                                            HasSubstr("The cost is CPU seconds of one estimate"),
                                                            HasSubstr("The cheapest method for an RMS error of 0.1")));
}

TEST_F(TradeCommand, UnreachedError_NamesTheSmallestErrors) {
  const ProcessResult r = run("rate_jump_2d --error 1e-9 --max-n 1024");
  EXPECT_EQ(r.exit_code, 1) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("  error 1e-09: not reached; smallest errors: "), HasSubstr(" at N = 1024"),
                              HasSubstr("; trade.csv has all 20; raise --max-n")));
}

TEST_F(TradeCommand, TimeBeyondTheLargestN_IsReported) {
  const ProcessResult r = run("pi --seconds 1,10 --max-n 256");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output,
              AllOf(ContainsRegex("[0-9]+ of [0-9]+ methods reached their largest N before 1 s; their error "),
                    HasSubstr(" before 10 s; "), HasSubstr("may be smaller: raise --max-n (for a scene --max")));
  EXPECT_THAT(mc::read_file(path("out/trade.json")), HasSubstr("\"ended\": true"));
}

TEST_F(TradeCommand, CurvesEndedByTime_AreCounted) {
  const std::string pi = "pi --error 1e-9 --max-n 256";
  EXPECT_THAT(run(pi).output, Not(HasSubstr("--time ended")));
  EXPECT_THAT(run(pi + " --time 0.001").output,
              ContainsRegex("--time ended [0-9]+ of them before N = 256; with more of it others may be cheaper"));
}

TEST_F(TradeCommand, CtrlC_PrintsResultSoFar) {
  const ProcessResult r = support::interrupt_carlo("trade pi --max-n 2e8 --threads 1 -o '" + path("out") + "'");
  EXPECT_EQ(r.exit_code, 130) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("interrupted: 0 of 23 methods were finished, one more up to N = "),
                              HasSubstr("  error 0.0314159: "), HasSubstr("data and plots: ")));
  EXPECT_THAT(mc::read_file(path("out/trade.json")), HasSubstr("\"interrupted\": true"));
  EXPECT_THAT(mc::read_file(path("out/trade.csv")), HasSubstr("random,16,"));
}

// Errors of 0 cannot be drawn on logarithmic axes.
TEST_F(TradeCommand, ExactIntegral_IsNotPlotted) {
  const ProcessResult r = run("'3+0*x' -d x=0:1 --max-n 64 --report '" + path("page") + "'");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("  error 0.03: "), HasSubstr("every method is exact to rounding")));
  EXPECT_THAT(mc::read_file(path("out/trade.csv")), HasSubstr("sobol,64,"));
}

TEST_F(TradeCommand, RemovesPlotsOfEarlierRuns) {
  std::filesystem::create_directories(path("out"));
  for (const char* picture : {"out/trade.svg", "out/trade.png"}) write(picture, "of another integrand");
  EXPECT_EQ(run("'3+0*x' -d x=0:1 --max-n 64").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("out/trade.svg")) || std::filesystem::exists(path("out/trade.png")));
  EXPECT_TRUE(std::filesystem::exists(path("out/trade.csv")));
}

// 2e-6 of the points are infinite: many methods meet none of them, and lose nothing.
TEST_F(TradeCommand, FailedMethodLosesItsRow) {
  const ProcessResult r = run("'if(abs(x-0.375)<1e-6,1/(x-x),x)' -d x=0:1 --error 0.01 --max-n 4096");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, testing::ContainsRegex("\n  [a-z_]+ failed: if.abs.x-0.375.<1e-6,1/.x-x.,x.: the integrand is "
                                               "(inf|-inf|nan) at x = 0.37[45999]+"));
  EXPECT_THAT(r.output, HasSubstr("\n  error 0.01: "));
  EXPECT_THAT(mc::read_file(path("out/trade.json")), AllOf(HasSubstr("\"failed\""), HasSubstr("\"reason\"")));
  EXPECT_THAT(run("'log(x)/sqrt(x)' -d x=0:1 --error 0.1 --max-n 1024").output, Not(HasSubstr("failed")));
}

TEST_F(TradeCommand, ComparesBatchesWithSingleCalls) {
  const ProcessResult r = run(std::string("--plugin '") + PLUGIN_DIR + "/integrands.so' Batch --error 0.1 --max-n 64");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(mc::read_file(path("out/trade.json")), HasSubstr("\"way\": \"sobol (one by one)\""));
}

TEST_F(TradeCommand, Scene_ListsMethodsAndBiases) {
  const std::string cbox = MC_SOURCE_DIR "/librender/scenes/cbox.xml --size 8x8 --samplers sobol --strategies ";
  const ProcessResult r =
      run(cbox + "light,mis --max-spp 32 --cost rays --error 0.5,1e-6 --report '" + path("page") + "'");
  EXPECT_EQ(r.exit_code, 1) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("cbox: 11 methods, millions of rays"), HasSubstr("  light sobol: bias "),
                              HasSubstr("  error 0.5: "), HasSubstr(" times faster than plain Monte Carlo\n"),
                              HasSubstr("  error 1e-06: not reached; smallest errors: ")));
  EXPECT_THAT(mc::read_file(path("out/trade.json")),
              AllOf(HasSubstr("\"way\": \"mis sobol adaptive\""), HasSubstr("\"way\": \"mis sobol splat\""),
                    HasSubstr("\"way\": \"mis sobol adaptive tiles\""), HasSubstr("\"way\": \"bsdf independent\""),
                    HasSubstr("\"million_rays\""), HasSubstr("\"gain_over_plain\""), HasSubstr("\"biases\""),
                    HasSubstr("\"reference\""), Not(HasSubstr("cpu_seconds"))));
  EXPECT_THAT(mc::read_file(path("out/trade.csv")), HasSubstr("way,n,million_rays,rms_error"));
  EXPECT_THAT(mc::read_file(path("page/index.html")),
              AllOf(HasSubstr("<th>millions of rays</th>"), HasSubstr("not reached; smallest error: "),
                    HasSubstr("cbox-11.png"), Not(HasSubstr("CPU"))));
  expect_refused(cbox + "miss", "did you mean 'mis'");
  expect_refused(cbox + "mis --max-spp 16", "--max-spp 16 must be at least 32");
  expect_refused(cbox + "mis --max-depths 0", "--max-depths: '0' in '0'");
  expect_refused(cbox + "mis --cost money", "--cost 'money' must be cpu or rays");
  expect_refused("nowhere.xml", "nowhere.xml");
  for (const char* of_integrals : {" --max-n 64", " -d x=0:1", " --timeout 3", " --memory 3"})
    expect_refused(cbox + "mis" + of_integrals, "--memory and --max-n are for an integrand; a scene (.xml)");
}

TEST_F(TradeCommand, CtrlC_OfAScenePrintsResultSoFar) {
  const ProcessResult r =
      support::interrupt_carlo("trade " MC_SOURCE_DIR "/librender/scenes/cbox.xml --size 4x4 --samplers sobol "
                               "--strategies mis --max-spp 1048576 --error 2 -o '" +
                                   path("out") + "'",
                               " at 128 spp");
  EXPECT_EQ(r.exit_code, 130) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("interrupted: errors up to "), HasSubstr(" samples per pixel are known"),
                              HasSubstr("  error 2: "), HasSubstr("data and plots: ")));
  EXPECT_THAT(mc::read_file(path("out/trade.json")), HasSubstr("\"interrupted\": true"));
}

TEST_F(TradeCommand, Scene_ExcludesStrategiesThatMissLights) {
  const std::string hard = MC_SOURCE_DIR "/librender/scenes/hard-shadows.xml --size 4x3 --samplers sobol --max-spp 32 ";
  const ProcessResult r = run(hard + "--cost rays --error 0.5");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  // nee and mis; even, adaptive, both with tiles. BSDF sampling cannot hit a point light, so there is no plain Monte
  // Carlo.
  EXPECT_THAT(r.output, AllOf(HasSubstr("hard-shadows: 8 methods"), Not(HasSubstr("plain Monte Carlo"))));
  expect_refused(hard + "--strategies mixture", "mixture");
}

TEST_F(TradeCommand, Scene_OfAovs) {
  // The scene has no light; only ambient occlusion makes the picture bright.
  const ProcessResult r =
      run(MC_SOURCE_DIR "/librender/scenes/ambient-occlusion.xml --size 4x3 --samplers sobol --max-spp 32 "
                        "--strategies mis --cost rays --error 0.5");
  EXPECT_EQ(r.exit_code, 0) << r.output;
}

TEST_F(TradeCommand, BadInput_IsReportedInOneLine) {
  expect_refused("", "trade: name one integrand");
  expect_refused("a.xml b.xml", "'a.xml' stands among others: scenes are measured one at a time; give it alone");
  expect_refused("'3+2' -d x=0:1", "'3+2' uses none of x: a constant has no error to measure; put a variable into it");
  expect_refused("genz", "trade: name one integrand");
  expect_refused("pi --error 0", "--error: '0' in '0' must be a number above 0");
  expect_refused("pi --error 1e-2,,1e-3", "--error: '' in '1e-2,,1e-3'");
  expect_refused("pi --max-spp 32", "--cost are for a scene (.xml)");
  expect_refused("pi --samplers sobol", "--samplers is for a scene (.xml)");
  expect_refused("pi --report /proc/none", "'/proc/none' is no folder and cannot be made one");
  expect_refused("pi --seconds 0", "--seconds: '0' in '0' must be a number above 0");
  expect_refused("pi --seconds 1e300", "--seconds: '1e300' in '1e300' must be a number above 0, and 1e+09 at most");
  expect_refused("pi --time 0", "--time 0 must lie in (0, 1e7] seconds");
  expect_refused("'0*x' -d x=0:1 --max-n 64", "the integrand was 0 at every point");
  expect_refused("x -d x=0:1e-300 --max-n 64", "are below 4.9e-324, the smallest");
}

} // namespace
