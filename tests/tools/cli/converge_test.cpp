// carlo converge: integrands of every kind, sampling methods, output files, and bad input.

#include <tools/interrupt_carlo.h>
#include <tools/run_carlo.h>

#include <support/files.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

namespace {

using support::ProcessResult;
using support::run_carlo;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Converge : support::ScratchTest {
  ProcessResult run(const std::string& arguments) const {
    return run_carlo("converge " + arguments + " --threads 1 -o '" + path("out") + "'");
  }
  void expect_refused(const std::string& arguments, const std::string& words) const {
    const ProcessResult refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments << "\n" << refused.output;
    EXPECT_EQ(std::count(refused.output.begin(), refused.output.end(), '\n'), 1) << refused.output;
    EXPECT_THAT(refused.output, HasSubstr(words));
  }
  std::string out(const std::string& file) const { return mc::read_file(path("out/" + file)); }
};

const std::string plugin = std::string("--plugin '") + PLUGIN_DIR + "/integrands.so' ";

TEST_F(Converge, Expression_NeedsNoTruth) {
  const ProcessResult r = run("'exp(-x*x)*cos(y)' -d x=0:1,y=-1:2 --max-n 1024 --report '" + path("page") + "'");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  // 0.5 sqrt(pi) erf(1) (sin 2 + sin 1)
  EXPECT_THAT(r.output, AllOf(HasSubstr("true value unknown; errors are relative to 1.3075"),
                              HasSubstr("sobol       RMS error ")));
  EXPECT_THAT(out("exp_-x_x__cos_y_.json"), AllOf(HasSubstr("\"truth_error\": "), HasSubstr("\"replicates\": ")));
  EXPECT_THAT(out("slopes.csv"), HasSubstr("exp(-x*x)*cos(y),unknown,2,sobol,"));
  const std::string page = mc::read_file(path("page/index.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("<polyline"), HasSubstr("reference 1.3075"), Not(HasSubstr("http"))));
}

// A disk by a condition, a simplex by its bounds, a normal variable: the estimated truths are near the known values.
TEST_F(Converge, Domains_MayBeRegions) {
  const std::pair<const char*, double> cases[] = {
      {"1 -d x=-1:1,y=-1:1 --where 'r<a' --let 'r=hypot(x,y)' --set a=1", 3.14159265},
      {"x*y -d x=0:1,y=0:x", 0.125},
      {"'z^2*k' -d z=normal,k=1..3", 6}};
  for (const auto& [arguments, truth] : cases) {
    const ProcessResult r = run(std::string(arguments) + " --max-n 1024");
    EXPECT_EQ(r.exit_code, 0) << r.output;
    const std::size_t at = r.output.find("relative to ");
    ASSERT_NE(at, std::string::npos) << r.output;
    EXPECT_NEAR(std::stod(r.output.substr(at + 12)) / truth, 1, 0.01) << r.output;
  }
  expect_refused("2 -d x=0:1", "'2' uses none of x");
  expect_refused("'a*x' -d x=0:1 --set a=1:2:1", "carlo integrate takes ranges");
  expect_refused("x y=0:1 -d x=0:1", "'y=0:1' is a bound");
  expect_refused("'exp(i*x)' -d x=0:1", "is complex");
  expect_refused("pi --let r=2", "'pi' has a domain of its own");
}

TEST_F(Converge, Scene_IsComparedWithAReference) {
  const ProcessResult r =
      run(MC_SOURCE_DIR "/librender/scenes/cbox.xml --size 8x8 --strategies mis --max-spp 16 --report '" +
          path("page") + "'");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("  mis stratified  RMS error "), HasSubstr("  mis sobol       RMS error "),
                              HasSubstr("from a reference of ")));
  EXPECT_THAT(out("cbox.csv"), HasSubstr("cbox,mis independent,16,"));
  EXPECT_THAT(out("cbox.json"), HasSubstr("\"reference\": {\n  \"spp\": "));
  EXPECT_THAT(out("slopes.csv"), HasSubstr(",independent samples\n"));
  const std::string page = mc::read_file(path("page/index.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("8&times;8 pixels; reference of "), HasSubstr("src=\"cbox-reference.png\""),
                          HasSubstr("The cost is CPU seconds of one picture.")));
  EXPECT_TRUE(std::filesystem::exists(path("page/cbox-3.png")));
  const std::string dark = write("dark.xml", R"(<scene version="0.5.0"><sensor type="perspective">
    <float name="fov" value="40"/></sensor>
    <shape type="sphere"><point name="center" x="0" y="0" z="5"/></shape></scene>)");
  expect_refused(dark + " --size 4x4 --max-spp 16", "the picture is black");
  expect_refused(dark + " --points-file p.csv", "--points-file is not for scenes");
  expect_refused(dark + " --max-n 64", "--memory and --max-n are for an integrand; a scene (.xml)");
  expect_refused("pi --max-n 1", "--max-n 1 must lie between 64 and 2^28"); // this is not the minimum of one sampler
}

// The warning of carlo render, printed once.
TEST_F(Converge, SceneTooLargeForFloat_IsWarnedAbout) {
  const std::string huge = write("huge.xml", R"(<scene version="0.5.0"><sensor type="perspective">
    <float name="fov" value="40"/></sensor><emitter type="constant"/>
    <shape type="sphere"><point name="center" x="0" y="0" z="5"/></shape>
    <shape type="sphere"><point name="center" x="0" y="0" z="3e20"/><float name="radius" value="1e20"/></shape>
    </scene>)");
  const std::string warning =
      "carlo: warning: " + huge + ": the scene is 4.9e+20 across; areas and squared distances in floats";
  for (const std::string command : {"converge ", "trade "}) {
    const std::string said =
        run_carlo(command + huge + " --size 4x4 --strategies mis --max-spp 32 --threads 1 -o '" + path("out") + "'")
            .output;
    EXPECT_THAT(said, HasSubstr(warning)) << command;
    EXPECT_EQ(said.find("carlo: warning"), said.rfind("carlo: warning")) << said;
  }
}

// A white sphere in a white furnace: the radiance is 1 everywhere, and pixels differ only by rounding.
TEST_F(Converge, NoiselessScene_IsRejected) {
  const std::string furnace = write("furnace.xml", R"(<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="2"/></integrator>
    <sensor type="perspective"><float name="fov" value="20"/><transform name="to_world">
      <lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform></sensor>
    <emitter type="constant"><rgb name="radiance" value="1,1,1"/></emitter>
    <shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="1,1,1"/></bsdf></shape></scene>)");
  expect_refused(furnace + " --size 4x4 --max-spp 16", "no picture has noise: there is no error to measure");
}

TEST_F(Converge, SceneWithAll_MeasuresEveryMethodUntilTimeRunsOut) {
  const ProcessResult r = run(MC_SOURCE_DIR "/librender/scenes/cbox.xml --size 2x2 --all --max-spp 1048576 --time 0.1");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  for (const char* name : {"  bsdf independent ", "  hemisphere sobol ", "  light stratified ", "  mis sobol "})
    EXPECT_THAT(r.output, HasSubstr(name));
  EXPECT_THAT(r.output, Not(HasSubstr("interrupted")));
}

TEST_F(Converge, All_MeasuresEveryMethodBesideTheory) {
  const ProcessResult r = run("rate_smooth_2d --all --max-n 4096 --replicates 64");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  for (const char* name :
       {"random ", "stratified ", "latin_hypercube ", "multi_jittered ", "halton ", "lattice ", "sobol ",
        "padded_sobol ", "padded_sobol_4d ", "stratified_rounds ", "rqmc ", "vegas ", "tree ", "auto "})
    EXPECT_THAT(r.output, HasSubstr(std::string("  ") + name));
  EXPECT_THAT(out("rate_smooth_2d.json"),
              AllOf(HasSubstr("\"class\": \"smooth\""), HasSubstr("\"source\": \"[Owen97]\""),
                    HasSubstr("\"slope_at_these_n\": "), HasSubstr("\"within_interval\": true"),
                    HasSubstr("\"at_least\": true")));
  EXPECT_THAT(out("slopes.csv"), HasSubstr(",at least as steep as -0.5000,"));
}

TEST_F(Converge, InfiniteVariance_IsReported) {
  const ProcessResult r = run("'x^-0.7' -d x=0:1 --max-n 4096 --report '" + path("page") + "'");
  const auto named = testing::ContainsRegex("the variance of the integrand looks infinite .the largest values fall off "
                                            "with index 1.[2-6]");
  EXPECT_THAT(r.output, named);
  EXPECT_THAT(mc::read_file(path("page/index.html")), named);
  EXPECT_THAT(out("x_-0_7.json"), HasSubstr("\"infinite_variance\": {\n  \"tail_index\": 1."));
  EXPECT_THAT(run("'exp(x)' -d x=0:1 --max-n 4096").output, Not(HasSubstr("variance")));
  EXPECT_THAT(out("exp_x_.json"), Not(HasSubstr("infinite_variance")));
  EXPECT_THAT(run_carlo("trade 'x^-0.7' -d x=0:1 --max-n 1024 -o '" + path("out") + "'").output, named);
}

TEST_F(Converge, ErrorBelowReferenceError_HasNoValue) {
  const ProcessResult r = run("'x<0.5 ? 1 : 0' -d x=0:1 --max-n 1024 --report '" + path("page") + "'");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output,
              testing::ContainsRegex("  sobol       RMS error at most 0[.0-9]+ at N = 1024, not distinguishable from"));
  EXPECT_THAT(out("x_0_5___1___0.csv"), HasSubstr(",sobol,1024,,0,"));
  EXPECT_THAT(out("x_0_5___1___0.json"), HasSubstr("\"rms_error\": null"));
  EXPECT_THAT(mc::read_file(path("page/index.html")), HasSubstr("&le; 0."));
}

TEST_F(Converge, HeavyTail_TakesMoreReplicates) {
  // The integrand is nonzero for one point in sixteen. Its RMS error needs more replicates for 10 % than normal errors
  // do.
  run("'x<0.0625 ? 1 : 0' -d x=0:1 --samplers random --max-n 64");
  EXPECT_THAT(out("x_0_0625___1___0.json"), Not(HasSubstr("\"replicates\": 64,")));
}

TEST_F(Converge, PointsFile_IsOneMoreSampler) {
  std::string halton;
  for (int i = 1; i <= 200; ++i) {
    double a = 0, b = 0, f = 0.5, g = 1 / 3.0;
    for (int k = i; k > 0; k /= 2, f /= 2) a += f * (k % 2);
    for (int k = i; k > 0; k /= 3, g /= 3) b += g * (k % 3);
    halton += fmt::format("{:.12f},{:.12f}\n", a, b);
  }
  const std::string good = write("p.csv", halton);
  const ProcessResult r = run("pi --points-file '" + good + "' --samplers random --max-n 4096");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, HasSubstr("p.csv       RMS error "));
  EXPECT_THAT(r.output, HasSubstr("at N = 128, ")) << "the largest power of two that the file holds";
  const ProcessResult closed = run("pi --points-file '" + write("closed.csv", halton + "0.5,1\n") +
                                   "' --rescale 0:1 --samplers random --max-n 128");
  EXPECT_EQ(closed.exit_code, 0) << closed.output;
  EXPECT_THAT(closed.output, HasSubstr("closed.csv: [0, 1] rescaled to [0, 1); 1 coordinate at the upper end became"));
  // A file named like a sampler is not that sampler.
  EXPECT_THAT(run("pi --points-file '" + write("sobol", halton) + "' --samplers sobol --max-n 128").output,
              HasSubstr("./sobol     RMS error "));
  expect_refused("ball_3d --points-file '" + good + "'", "p.csv: 2 columns; ball_3d has 3 dimensions");
  expect_refused("pi --points-file '" + write("few.csv", "0.5,0.5\n") + "'", "few.csv: 1 points; 64 to ");
  expect_refused("pi --points-file '" + write("off.csv", halton + "0.5,1\n") + "'",
                 "off.csv:201: coordinate 2 is 1; it must lie in [0, 1)");
  expect_refused("pi --points-file '" + write("bad.csv", halton + "0.5,zero\n") + "'",
                 "bad.csv:201: 'zero' is not a number");
}

TEST_F(Converge, Plugin_IntegrandsAreMeasured) {
  const ProcessResult r = run(plugin + "Sum Batch --max-n 256");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("x + y over a box"), HasSubstr("Batch\n")));
  // The same integrand, called with single points and in batches.
  const auto errors = [&](const std::string& name) {
    std::string text = out(name + ".csv");
    std::string column;
    for (std::size_t at = text.find("random,"); at != std::string::npos; at = text.find("random,", at + 1))
      column += text.substr(at, 30);
    return column;
  };
  EXPECT_EQ(errors("Sum"), errors("Batch"));
  EXPECT_NE(errors("Sum"), "");
}

TEST_F(Converge, WrongTruth_IsReported) {
  const ProcessResult r = run(plugin + "WrongTruth --max-n 1024");
  EXPECT_EQ(r.exit_code, 1) << r.output;
  EXPECT_THAT(r.output, HasSubstr("the stated truth 1.01 is wrong, or the integrand is: errors stop falling at 0.01"));
  EXPECT_EQ(run(plugin + "Sum --max-n 1024").exit_code, 0);
}

TEST_F(Converge, FaultyPlugin_IsReportedInOneLine) {
  expect_refused(plugin + "Pairs --max-n 64", "eval_many, as point 252 of 253, nan; values[i] must be eval(x + i dim)");
  expect_refused(plugin + "Remembers --max-n 64", "Remembers: at x = (");
  expect_refused(plugin + "Remembers --max-n 64", "; it must depend on x alone, on nothing before");
  expect_refused(plugin + "Crash --max-n 64", "it crashed in eval at x = (");
  expect_refused(plugin + "NaN --max-n 64", "NaN: the integrand is nan at x = (");
  expect_refused(plugin + "Hang --max-n 64 --timeout 1", "it hangs in eval at x = (");
  expect_refused(plugin + "Slow --max-n 64 --timeout 1", "; raise --timeout or lower --max-n");
  expect_refused(plugin + "Smu --max-n 64", "unknown integrand 'Smu'; did you mean 'Sum'?");
  expect_refused(std::string("--plugin '") + PLUGIN_DIR + "/right.so'", "it contains distributions but no integrands");
}

TEST_F(Converge, BadInput_IsReportedInOneLine) {
  expect_refused("'sin(q)' -d x=0:1", "expression 'sin(q)', position");
  expect_refused("'sin(x)'", "is not a name of --list; for an expression give --domain");
  expect_refused("'x' -d x=1:0", "lo < hi is needed");
  expect_refused("pi --samplers vegas,random --max-n 64", "--max-n 64: vegas takes N of at least 2048; raise it, or");
  expect_refused("'1/(x-x)' -d x=0:1 --max-n 64", "1/(x-x): the integrand is inf at x = 0.");
  expect_refused("'0*x' -d x=0:1 --max-n 64", "0*x: the integrand was 0 at every point; choose bounds around");
  expect_refused("x -d x=0:1e-300", "'x': its values times the volume of 'x=0:1e-300' are below 4.9e-324, the");
  expect_refused("'3+2' -d x=0:1", "'3+2' uses none of x: a constant has no error to measure; put a variable into it");
  expect_refused("'_pi' -d x=0:1,y=0:1", "'_pi' uses none of x, y: ");
  expect_refused("a.xml b.xml", "'a.xml' stands among others: scenes are measured one at a time; give it alone");
  expect_refused("pi b.xml", "'b.xml' stands among others");
  expect_refused("pi --max-n 64 --timeout 3", "--timeout is for foreign code: a --plugin or a --command");
  expect_refused("pie", "unknown integrand 'pie'; did you mean 'pi'?");
  expect_refused("3", "for an expression give --domain");
  expect_refused("pi --cost rays", "--cost are for a scene (.xml)");
  expect_refused("pi --samplers sobl", "unknown method 'sobl'; did you mean 'sobol'?");
  expect_refused("pi --time 0", "--time 0 must lie in (0, 1e7] seconds");
  expect_refused("pi --replicates 3", "--replicates 3 must lie in [8, 100000], or be 0");
  expect_refused("pi -d x=0:1 pi", "--domain belongs to one expression");
  EXPECT_THAT(run_carlo("converge pi -o /proc/none").output,
              HasSubstr("'/proc/none' is no folder and cannot be made one"));
  EXPECT_FALSE(std::filesystem::exists(path("out/pi.csv")));
}

TEST_F(Converge, UnusedVariable_IsAccepted) {
  const ProcessResult r = run("'x' -d x=0:1,y=0:1 --samplers random --max-n 64");
  EXPECT_EQ(r.exit_code, 0) << r.output;
}

TEST_F(Converge, ListExplainsAuto) {
  EXPECT_THAT(run_carlo("converge --list").output,
              AllOf(HasSubstr("\n  tree  "), HasSubstr("the best of rqmc, vegas and tree\n")));
}

// The interrupt cuts the first of three curves; it is written with the N that it has finished.
TEST_F(Converge, CtrlC_KeepsTheInterruptedCurve) {
  const ProcessResult r = support::interrupt_carlo("converge pi --max-n 2e8 --threads 1 -o '" + path("out") +
                                                   "' --report '" + path("page") + "'");
  EXPECT_EQ(r.exit_code, 130) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("; interrupted\r\n"),
                              HasSubstr("interrupted: 0 of 3 curves were finished, one more up to N = ")));
  EXPECT_THAT(out("pi.csv"), HasSubstr("pi,random,16,"));
  EXPECT_THAT(out("pi.json"), HasSubstr("\"interrupted\": true"));
  EXPECT_THAT(mc::read_file(path("page/index.html")), HasSubstr("truth 3.14159265359; jump; interrupted"));
}

TEST_F(Converge, TimeLimit_StopsAtSmallerN) {
  const ProcessResult r = run("genz_oscillatory_5d --max-n 1e8 --time 0.3");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, HasSubstr("--time ended "));
  EXPECT_THAT(out("genz_oscillatory_5d.csv"), AllOf(HasSubstr("sobol,64,"), Not(HasSubstr(",67108864,"))));
}

TEST_F(Converge, ResultsDoNotDependOnThreads) {
  const auto errors = [&](const std::string& threads) {
    run_carlo("converge pi --samplers sobol,vegas --max-n 4096 --replicates 16 --threads " + threads + " -o '" +
              path("t" + threads) + "'");
    std::string text = mc::read_file(path("t" + threads + "/pi.csv")), kept;
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
      end = text.find('\n', begin);
      const std::string line = text.substr(begin, end - begin);
      kept += line.substr(0, line.rfind(',')) + "\n"; // without the seconds
    }
    return kept;
  };
  EXPECT_EQ(errors("1"), errors("2"));
}

} // namespace
