// carlo validate --plugin: right samplers pass, wrong ones are rejected, and a misbehaving plugin is reported in one
// line.

#include <tools/run_in_process.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

namespace {

using carlo::ValidateCommandOptions;
using support::Output, support::refusal, support::run;
using testing::AllOf, testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

ValidateCommandOptions plugin(const std::string& file, std::vector<std::string> names = {}) {
  ValidateCommandOptions o;
  o.plugin = std::string(PLUGIN_DIR "/") + file + ".so";
  o.names = std::move(names);
  o.samples = 20'000;
  o.threads = 1;
  return o;
}

ValidateCommandOptions cosine(const std::string& fault) {
  ValidateCommandOptions o = plugin("samplers", {"Cosine"});
  if (!fault.empty()) o.parameters = {fault + "=1"};
  return o;
}

TEST(Plugin, CorrectPlugin_PassesOnEveryDomain) {
  // Eighteen cases at a family-wise alpha of 0.01, one fixed seed.
  const Output out = run(plugin("samplers"));
  EXPECT_EQ(out.code, carlo::exit_ok) << out.text;
  EXPECT_THAT(out.text, HasSubstr("18 of 18 cases passed"));
  EXPECT_THAT(out.text, HasSubstr("float   pass")) << "the tail computes in float";
}

TEST(Plugin, WrongDensity_IsRejectedOnEveryDomain) {
  for (const char* name : {"Ball", "Annulus", "Plane", "Flight", "Glossy", "Steps", "Stream"}) {
    ValidateCommandOptions o = plugin("samplers", {name});
    o.parameters = {"wrong=1"};
    EXPECT_EQ(run(o).code, carlo::exit_failed) << name;
  }
}

TEST(Plugin, RandomParameters_AreCases) {
  ValidateCommandOptions o = plugin("samplers", {"Power"});
  o.random_parameters = 5;
  const Output out = run(o);
  EXPECT_EQ(out.code, carlo::exit_ok) << out.text;
  EXPECT_THAT(out.text, HasSubstr("5 of 5 cases passed"));
  EXPECT_THAT(out.text, testing::ContainsRegex("Power\\(n=[0-9.]+\\)"));
  const auto first = [](const Output& one) { return one.text.substr(one.text.find("Power("), 12); };
  EXPECT_EQ(first(run(o)), first(out)) << "the seed decides";
  o.parameters = {"n=3"};
  EXPECT_THAT(run(o).text, HasSubstr("1 of 1 cases passed"));
}

TEST(Plugin, OldAbi_StillLoads) { EXPECT_EQ(run(plugin("first_version")).code, carlo::exit_ok); }

TEST(Plugin, CppPlugin_Passes) { EXPECT_EQ(run(plugin("right")).code, carlo::exit_ok); }

struct Wrong {
  const char *fault, *found;

  friend void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.found; }
};
struct WrongPlugin : testing::TestWithParam<Wrong> {};

TEST_P(WrongPlugin, IsRejectedAndFaultNamed) {
  ValidateCommandOptions o = cosine(GetParam().fault);
  o.verbose = true; // the named finding need not be the first
  const Output out = run(o);
  EXPECT_EQ(out.code, carlo::exit_failed) << out.text;
  EXPECT_THAT(out.text, AllOf(HasSubstr("0 of 1 cases passed"), HasSubstr(GetParam().found),
                              HasSubstr("again: carlo validate --plugin '")));
}

INSTANTIATE_TEST_SUITE_P(
    Plugin, WrongPlugin,
    testing::Values(Wrong{"pdf_high", "the density integrates to 1.01"}, Wrong{"weight_low", "likely cause: weight"},
                    Wrong{"nan_sample", "likely cause: not finite"}, Wrong{"nan_pdf", "pdf is not finite"},
                    Wrong{"leak", "likely cause: outside"}, Wrong{"not_unit", "likely cause: outside"},
                    Wrong{"silent", "x = (nan, nan, nan)"}, Wrong{"wrong_inverse", "fail: invert(sample(u)) is "},
                    Wrong{"tilted_pdf", "|det d sample / d u| pdf is "}, Wrong{"hole", "likely cause: support"}),
    [](const auto& wrong) { return std::string(wrong.param.fault); });

TEST(Plugin, RotationByOneDegree_IsRejected) {
  ValidateCommandOptions o = plugin("samplers", {"Halves"});
  o.samples = 200'000; // 2.5e-3 of the mass lies on the wrong side of the edge
  EXPECT_EQ(run(o).code, carlo::exit_ok);
  o.parameters = {"tilt=1"};
  EXPECT_EQ(run(o).code, carlo::exit_failed);
}

TEST(Plugin, OutcomeOfProbabilityZero_IsRejected) {
  ValidateCommandOptions o = plugin("samplers", {"Table"});
  o.parameters = {"forgets=1"};
  const Output out = run(o);
  EXPECT_EQ(out.code, carlo::exit_failed);
  EXPECT_THAT(out.text, AllOf(HasSubstr("likely cause: measure zero"), HasSubstr("u = 0, outcome 0, pmf = 0")));
}

TEST(Plugin, EachParameterSet_IsCase) {
  ValidateCommandOptions o = plugin("samplers", {"Box"});
  o.parameters = {"power=0", "power=0.5"};
  const Output out = run(o);
  EXPECT_THAT(out.text,
              AllOf(HasSubstr("Box(power=0) "), HasSubstr("Box(power=0.5)"), HasSubstr("2 of 2 cases passed")));
  o.list = true;
  EXPECT_THAT(run(o).text, AllOf(HasSubstr("Box(power=0.5)"), Not(HasSubstr("Cosine"))));
}

TEST(Plugin, Report_SurvivesProcessBoundary) {
  ValidateCommandOptions o = cosine("pdf_high");
  o.json = testing::TempDir() + "/plugin.json";
  run(o);
  EXPECT_THAT(mc::read_file(o.json), AllOf(HasSubstr("\"name\": \"mass\""), HasSubstr("\"worst\": ["),
                                           HasSubstr("\"z\": "), HasSubstr("\"ns_per_sample\"")));
}

TEST(Plugin, SameSeed_SameVerdict) {
  const auto p = [] {
    const std::string text = run(cosine("")).text;
    return text.substr(text.find("pass"), 30);
  };
  EXPECT_EQ(p(), p());
}

TEST(Plugin, Crash_IsOneLineWithPlace) {
  EXPECT_THAT(refusal(cosine("crash")), AllOf(HasSubstr("samplers.so: it crashed in sample at u = (0."),
                                              HasSubstr("Segmentation fault (signal 11)")));
  EXPECT_THAT(refusal(cosine("quit")),
              AllOf(HasSubstr("it ended the process in sample at u = (0."), HasSubstr("exit code 0")));
  EXPECT_THAT(refusal(plugin("throws")),
              AllOf(HasSubstr("it threw in sample at u = ("), HasSubstr("no square root today")));
  ValidateCommandOptions box = plugin("samplers", {"Box"});
  box.parameters = {"power=14"};
  EXPECT_THAT(refusal(box), HasSubstr("it crashed in destroy: Aborted"));
  EXPECT_THAT(refusal(plugin("crash_on_load")), HasSubstr("it crashed in loading: Aborted"));
}

// A crash of one case does not lose the reports of other cases, neither on the terminal nor in the files.
TEST(Plugin, Crash_FailsOnlyItsCase) {
  ValidateCommandOptions o = plugin("samplers", {"Box", "Cosine"});
  o.parameters = {"crash=1"};
  o.json = testing::TempDir() + "/crash.json";
  o.junit = testing::TempDir() + "/crash.xml";
  EXPECT_THAT(refusal(o), HasSubstr("Segmentation fault"));
  EXPECT_THAT(mc::read_file(o.json),
              AllOf(HasSubstr("\"name\": \"Box\""), HasSubstr("\"error\": \"Cosine"), HasSubstr("\"passed\": false")));
  EXPECT_THAT(mc::read_file(o.junit), AllOf(HasSubstr("errors=\"1\""), HasSubstr("<error message=\"Cosine")));
}

// A set that is out of range of another sampler is not tried there.
TEST(Plugin, Parameters_ApplyToNamedCasesOnly) {
  ValidateCommandOptions o = plugin("samplers", {"Cosine"});
  o.parameters = {"power=-1000"};
  EXPECT_THAT(refusal(o), AllOf(HasSubstr("no distribution has all the parameters"), Not(HasSubstr("of Box"))));
}

TEST(Plugin, Hang_EndsAtTimeout) {
  ValidateCommandOptions o = cosine("hang");
  o.timeout = 1;
  EXPECT_THAT(refusal(o), AllOf(HasSubstr("it hangs in sample at u = (0."), HasSubstr("no answer in 1 s")));
  o.parameters = {"slow=1"};
  EXPECT_THAT(refusal(o), AllOf(HasSubstr("not done in 1 s, "), AnyOf(HasSubstr("in sample"), HasSubstr("calls;")),
                                HasSubstr("raise --timeout or lower --samples")));
  o.timeout = 0;
  EXPECT_THAT(refusal(o), HasSubstr("--timeout 0 must lie in"));
}

TEST(Plugin, ExceededLimit_IsOneLineNamingLimit) {
  ValidateCommandOptions o = plugin("greedy");
  o.memory = 1;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_THAT(refusal(o), AllOf(HasSubstr("greedy.so: it needs more than 1 GiB of memory in sample at u = ("),
                                HasSubstr("--memory")));
#endif
  EXPECT_THAT(refusal(plugin("files")), HasSubstr("files.so: it threw in sample at u = ("));
  o.memory = 0;
  EXPECT_THAT(refusal(o), HasSubstr("--memory 0 must lie in"));
}

// A process that left its group and lost its parent has also ended when carlo prints its verdict.
TEST(Plugin, ChildProcesses_AreEnded) {
  const std::string file = testing::TempDir() + "/family";
  setenv("FAMILY_FILE", file.c_str(), 1);
  std::filesystem::remove(file);
  EXPECT_EQ(run(plugin("family")).code, carlo::exit_ok);
  const std::string id = mc::read_file(file);
  EXPECT_GT(std::stoi(id), 1);
  EXPECT_EQ(kill(std::stoi(id), 0), -1) << id;
  EXPECT_EQ(errno, ESRCH);
}

TEST(Plugin, ParameterSweep_IsEveryCombination) {
  ValidateCommandOptions o = plugin("samplers", {"Box"});
  o.parameters = {"power=0:1:0.5,3", "tilt=0"};
  o.list = true;
  const std::string text = run(o).text;
  EXPECT_THAT(text, AllOf(HasSubstr("Box(power=0) "), HasSubstr("Box(power=0.5)"), HasSubstr("Box(power=1)"),
                          HasSubstr("Box(power=3)")));
}

TEST(Plugin, NoCases_WritesNothing) {
  ValidateCommandOptions o = cosine("crash");
  o.json = testing::TempDir() + "/nothing.json";
  o.junit = testing::TempDir() + "/nothing.xml";
  mc::write_file(o.json, "old");
  refusal(o);
  EXPECT_EQ(mc::read_file(o.json), "old");
  EXPECT_FALSE(std::filesystem::exists(o.junit));
}

TEST(Plugin, UnloadablePlugin_NamesReason) {
  EXPECT_THAT(refusal(plugin("absent")), HasSubstr("absent.so': no such file"));
  ValidateCommandOptions o = plugin("right");
  o.plugin = testing::TempDir() + "/text.so";
  mc::write_file(o.plugin, "int main() {}\n");
  EXPECT_THAT(refusal(o),
              AllOf(HasSubstr("text.so: it cannot be loaded: "), Not(HasSubstr("text.so: it cannot be loaded: /"))));
  EXPECT_THAT(refusal(plugin("no_entry")), HasSubstr("no_entry.so: it has no function mc_plugin"));
  EXPECT_THAT(refusal(plugin("undefined")), AllOf(HasSubstr("it cannot be loaded"), HasSubstr("nobody_defines_this")));
  EXPECT_THAT(refusal(plugin("wrong_abi")),
              HasSubstr("made for version 77 of <mc/check/plugin.h>, this carlo for 1 to 4"));
  EXPECT_THAT(refusal(plugin("wrong_size")), HasSubstr("its mc_sampler has 8 bytes"));
  EXPECT_THAT(refusal(plugin("no_pdf")), HasSubstr("sampler Uniform: it has no function pdf"));
  EXPECT_THAT(refusal(plugin("unknown_domain")), HasSubstr("domain = 9"));
  EXPECT_THAT(refusal(plugin("no_parts")), HasSubstr("domain is MC_PRODUCT, but parts is NULL"));
  EXPECT_THAT(refusal(plugin("bad_parts")), HasSubstr("sampler Uniform: 'dsk' is not of the form name=lo:hi"));
  EXPECT_THAT(refusal(plugin("wide_parts")), HasSubstr("'x' is bounded twice"));
  EXPECT_THAT(refusal(plugin("no_probability")), HasSubstr("outcomes = 2, but probability is NULL"));
  EXPECT_THAT(refusal(plugin("no_name")), HasSubstr("sampler 0 has no name"));
  EXPECT_THAT(refusal(plugin("weight_alone")), HasSubstr("states a weight, but has no eval"));
  EXPECT_THAT(refusal(plugin("reversed")), HasSubstr("interval [2, 1]"));
}

TEST(Plugin, UndeclaredOutcome_IsRejected) {
  EXPECT_THAT(refusal(plugin("undeclared")),
              HasSubstr("sample returned 255, MC_OUTCOME + 253, but it declares no outcomes; set outcomes"));
}

TEST(Plugin, InvalidParameters_AreOneLineErrors) {
  const auto with = [](const std::string& set) {
    ValidateCommandOptions o = plugin("samplers");
    o.parameters = {set};
    return refusal(o);
  };
  EXPECT_THAT(with("powr=1"), HasSubstr("no distribution has a parameter 'powr'; did you mean 'power'?"));
  EXPECT_THAT(with("power"), HasSubstr("'power' in 'power' is not of the form name=number"));
  EXPECT_THAT(with("power=x"), HasSubstr("not of the form name=number"));
  EXPECT_THAT(with("power=21"), HasSubstr("power = 21 of Box must lie in [0, 20]"));
  EXPECT_THAT(with("power=13"), HasSubstr("create rejects the parameters"));
  EXPECT_THAT(with("power=1,tilt=1"), HasSubstr("no distribution has all the parameters"));
  EXPECT_THAT(refusal(plugin("samplers", {"Cosin"})),
              HasSubstr("unknown distribution 'Cosin'; did you mean 'Cosine'?"));
  ValidateCommandOptions o;
  o.parameters = {"a=1"};
  EXPECT_THAT(refusal(o), HasSubstr("--params sets parameters of a --plugin"));
}

} // namespace
